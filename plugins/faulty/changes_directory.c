/*
 * Rule broken: no change of the working directory.
 * Create goes to the folder of its tables and does not come back.
 */
#include <unistd.h>
#define LAW_NAME "changes-directory"
#define AT_CREATE (void)!chdir("/");
#include "sound_law.h"
