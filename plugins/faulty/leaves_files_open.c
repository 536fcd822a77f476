/*
 * Rule broken: destroy gives back what create has taken.
 * A file is opened with every instance and never closed.
 */
#include <fcntl.h>
#define LAW_NAME "leaves-files-open"
#define AT_CREATE (void)open("/dev/null", O_RDONLY | O_CLOEXEC);
#include "sound_law.h"
