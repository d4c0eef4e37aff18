/* How the processor computes: the kernels' way while they run, the host's again afterwards.
 *
 * Hosts change it: rounding for interval arithmetic, subnormal numbers as zero for audio, traps for debugging.
 * The kernels were checked, and give the same bits, in the way a process starts with. */
#ifndef FB_FLOAT_MODE_H
#define FB_FLOAT_MODE_H

#include <stdint.h>

#if defined __x86_64__

typedef struct FloatMode {
    uint32_t sse; /* MXCSR */
    uint16_t x87; /* control word: some C libraries compute with it */
} FloatMode;

enum {
    SSE_CONTROL = 0xffc0, /* the rest are flags that operations raise */
    SSE_START = 0x1f80,   /* round to nearest, nothing trapped, subnormal numbers kept */
    X87_CONTROL = 0x0f3f,
    X87_START = 0x037f
};

/* Note the host's way, and compute in that of a fresh process. */
static inline FloatMode float_mode_take(void)
{
    const uint32_t sse = SSE_START;
    const uint16_t x87 = X87_START;
    FloatMode host;
    __asm__ volatile("stmxcsr %0" : "=m"(host.sse));
    __asm__ volatile("fnstcw %0" : "=m"(host.x87));
    if ((host.sse & SSE_CONTROL) != SSE_START) __asm__ volatile("ldmxcsr %0" : : "m"(sse));
    if ((host.x87 & X87_CONTROL) != (X87_START & X87_CONTROL)) __asm__ volatile("fldcw %0" : : "m"(x87));
    return host;
}

/* Compute in the host's way again. */
static inline void float_mode_give_back(FloatMode host)
{
    if ((host.sse & SSE_CONTROL) != SSE_START) __asm__ volatile("ldmxcsr %0" : : "m"(host.sse));
    if ((host.x87 & X87_CONTROL) != (X87_START & X87_CONTROL)) {
        /* flags raised meanwhile would trap behind it */
        __asm__ volatile("fnclex\n\tfldcw %0" : : "m"(host.x87));
    }
}

#elif defined __aarch64__

typedef struct FloatMode {
    uint64_t fpcr;
} FloatMode;

/* Note the host's way, and compute in that of a fresh process. */
static inline FloatMode float_mode_take(void)
{
    const uint64_t start = 0; /* round to nearest, nothing trapped, subnormal numbers kept */
    FloatMode host;
    __asm__ volatile("mrs %0, fpcr" : "=r"(host.fpcr));
    if (host.fpcr != start) __asm__ volatile("msr fpcr, %0" : : "r"(start));
    return host;
}

/* Compute in the host's way again. */
static inline void float_mode_give_back(FloatMode host)
{
    if (host.fpcr != 0) __asm__ volatile("msr fpcr, %0" : : "r"(host.fpcr));
}

#else
#error "how this processor computes is not known here"
#endif

#endif
