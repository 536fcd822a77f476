/* Allowed: a derivative that jumps where the law changes branch, if WL_FLAG_KINKS says so. */
#define LAW_NAME "declared-kink"
#define LAW_FLAGS WL_FLAG_KINKS
#define LAW_DEGREE NAN
#define INCREMENT (K / H * (p > 0.01 * H ? p + 4 * (p - 0.01 * H) : p) * s)
#define SLOPE (K / H * (p > 0.01 * H ? 5 : 1) * s)
#include "../faulty/sound_law.h"
