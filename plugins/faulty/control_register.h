/* control_register.h: sets the control register of the floating-point unit itself, since newer compilers no longer do. */
#ifndef CONTROL_REGISTER_H
#define CONTROL_REGISTER_H

#include <stdint.h>

/* Results and operands below the normal range become zero, in the calling thread. */
static inline void flush_to_zero(void) {
#if defined(__x86_64__)
    uint32_t mxcsr;
    __asm__ volatile("stmxcsr %0" : "=m"(mxcsr));
    mxcsr |= 0x8040;
    __asm__ volatile("ldmxcsr %0" : : "m"(mxcsr));
#elif defined(__aarch64__)
    uint64_t fpcr;
    __asm__ volatile("mrs %0, fpcr" : "=r"(fpcr));
    fpcr |= (uint64_t)1 << 24;
    __asm__ volatile("msr fpcr, %0" : : "r"(fpcr));
#endif
}

#endif /* CONTROL_REGISTER_H */
