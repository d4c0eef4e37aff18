#include "kernels.h"

#include <stdlib.h>
#include <string.h>

#if defined _WIN32
#define HIDDEN /* a DLL exports only what is named */
#else
#define HIDDEN __attribute__((visibility("hidden")))
#endif

/* Whether the kernels serve a model with the parameters p. */
static int serve(const double *p, Text *why)
{
#ifdef FB_ALONE
    if (p[FB_ALONE] == 0.0) {
        text_add(why, "this library holds the equations of single bearings alone, and the model is a set: "
                      "build its FMU from its scene", NULL);
        return 0;
    }
#endif
    (void)p;
    (void)why;
    return 1;
}

#ifdef FB_X86
#include <cpuid.h>

HIDDEN KernelInit fb_init_v3;
HIDDEN KernelStep fb_step_v3;
HIDDEN KernelDerivative fb_derivative_v3;
HIDDEN KernelOutputs fb_outputs_v3;
HIDDEN KernelCopy fb_copy_v3;

static const Kernels V3 = {fb_init_v3, fb_step_v3, fb_derivative_v3, fb_outputs_v3, fb_copy_v3};

#ifdef FB_NEWER_ONLY
static const Kernels *const OLDER = NULL;
#else
HIDDEN KernelInit fb_init_v2;
HIDDEN KernelStep fb_step_v2;
HIDDEN KernelDerivative fb_derivative_v2;
HIDDEN KernelOutputs fb_outputs_v2;
HIDDEN KernelCopy fb_copy_v2;

static const Kernels V2 = {fb_init_v2, fb_step_v2, fb_derivative_v2, fb_outputs_v2, fb_copy_v2};
static const Kernels *const OLDER = &V2;
#endif

/* Whether all of some bits are set. */
static int all(unsigned value, unsigned bits)
{
    return (value & bits) == bits;
}

/* Whether the operating system keeps the upper halves of the vector registers. */
static int keeps_ymm(void)
{
    unsigned low, high;
    __asm__ volatile("xgetbv" : "=a"(low), "=d"(high) : "c"(0));
    return all(low, 6U);
}

/* Level of the processor: 0, or 2 or 3 for x86-64-v2 or -v3. */
static int processor_level(void)
{
    const unsigned v2 = bit_SSE3 | bit_SSSE3 | bit_SSE4_1 | bit_SSE4_2 | bit_POPCNT | bit_CMPXCHG16B;
    const unsigned v3 = bit_AVX | bit_FMA | bit_F16C | bit_MOVBE | bit_OSXSAVE;
    const unsigned v3_more = bit_AVX2 | bit_BMI | bit_BMI2;
    unsigned a, b, c, d, more = 0, extended = 0;
    if (!__get_cpuid(1, &a, &b, &c, &d) || !all(c, v2)) return 0;
    if (!all(c, v3) || !keeps_ymm()) return 2;
    if (__get_cpuid_count(7, 0, &a, &b, &c, &d)) more = b;
    if (__get_cpuid(0x80000001U, &a, &b, &c, &d)) extended = c;
    return all(more, v3_more) && all(extended, bit_LZCNT) ? 3 : 2;
}

/* The kernels for this processor and a model with the parameters p. */
const Kernels *kernels_choose(const double *p, Text *why)
{
    const char *wanted = getenv("FMU_BEARING_ISA");
    int level = processor_level();
    if (!serve(p, why)) return NULL;
    if (level < 2) {
        text_add(why, "this processor lacks instructions of x86-64-v2 (SSE4.2, POPCNT): nothing older can run "
                      "this library", NULL);
        return NULL;
    }
    if (level < 3 && !OLDER) {
        text_add(why, "this library was built for x86-64-v3 alone (AVX2), which this processor lacks: "
                      "build the FMU without --only-here", NULL);
        return NULL;
    }
    return level < 3 || (OLDER && wanted && strcmp(wanted, "v2") == 0) ? OLDER : &V3;
}

#else

HIDDEN KernelInit fb_init_base;
HIDDEN KernelStep fb_step_base;
HIDDEN KernelDerivative fb_derivative_base;
HIDDEN KernelOutputs fb_outputs_base;
HIDDEN KernelCopy fb_copy_base;

static const Kernels BASE = {fb_init_base, fb_step_base, fb_derivative_base, fb_outputs_base, fb_copy_base};

/* The kernels for a model with the parameters p: one set for all processors. */
const Kernels *kernels_choose(const double *p, Text *why)
{
    return serve(p, why) ? &BASE : NULL;
}
#endif
