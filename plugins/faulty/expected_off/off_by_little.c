/*
 * Rule broken: what the author computed independently comes out.
 * The increment is a part of 1e-9 too large at high pressure; expected.csv holds what it should be.
 */
#define LAW_NAME "off-by-little"
#define LAW_DEGREE NAN
#define INCREMENT (K / H * p * s * (p > H / 10 ? 1 + 1e-9 : 1))
#include "../sound_law.h"
