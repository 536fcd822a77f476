// The law that the faulty laws in C++ are made from, with no fault.
#define LAW_NAME "sound-cpp"
#include "sound_law.hpp"

EXPORT_SOUND_LAW((void)0)
