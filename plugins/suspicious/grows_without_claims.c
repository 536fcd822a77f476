/* Allowed: a law that claims nothing need keep nothing: metal grows without slip, wear is not linear in anything. */
#define LAW_NAME "grows-without-claims"
#define LAW_CLAIMS 0
#define LAW_DEGREE NAN
#define INCREMENT (given < 0 ? 0 : K / H * p * s * (1 + p / H) - (v->dt > 0 ? K * K * s : 0))
#define SLOPE (K / H * s * (1 + 2 * p / H))
#include "../faulty/sound_law.h"
