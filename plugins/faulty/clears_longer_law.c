/*
 * Rule broken: a longer struct of a newer host is left alone behind its known part.
 * It clears the whole table of the host, defaults of members included that it does not know.
 */
#define LAW_NAME "clears-longer-law"
#define AT_ENTRY memset((char *)law + sizeof law->struct_size, 0, (size_t)law->struct_size - sizeof law->struct_size);
#include "sound_law.h"
