/*
 * Rule broken: claims are those of the table.
 * It claims what nobody knows.
 */
#define LAW_NAME "unknown-claim"
#define LAW_CLAIMS (WL_CLAIMS_KNOWN | 1 << 20)
#include "sound_law.h"
