/* The law that all faulty laws in C are made from, with no fault: no probe and no check may find anything in it. */
#include "sound_law.h"
