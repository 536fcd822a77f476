/* scrambled.h: picks few points out of many by the bits of a number, so that no round input hits them. */
#ifndef SCRAMBLED_H
#define SCRAMBLED_H

#include <stdint.h>
#include <string.h>

/* 64 bits that look random, the same for the same number (a multiplicative hash). */
static inline uint64_t scrambled(double x) {
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    bits *= 0x9e3779b97f4a7c15;
    return (bits ^ bits >> 29) * 0xbf58476d1ce4e5b9;
}

#endif /* SCRAMBLED_H */
