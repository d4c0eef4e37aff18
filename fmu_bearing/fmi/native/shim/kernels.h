/* The compiled equations: one set of entries per instruction set, chosen when an instance is made.
 *
 * The build defines FB_KERNELS, a string of 64 hexadecimal digits that names the equations, and FB_X86
 * where the library holds kernels for x86-64-v2 and x86-64-v3 rather than one set for any processor. A library
 * for few also has FB_NEWER_ONLY, where those for x86-64-v2 are left out, and FB_ALONE, where the kernels serve
 * single bearings alone: the place in p of what tells them from sets. */
#ifndef FB_KERNELS_H
#define FB_KERNELS_H

#include "text.h"

#include <stdint.h>

typedef int32_t KernelInit(
    const double *p, const double *u, double *s, double *z, double *w, const int64_t *sizes, double time);
typedef int32_t KernelStep(
    const double *p, const double *u, double *s, double *z, double *w, const int64_t *sizes, double h);
typedef int32_t KernelOutputs(const double *p, const double *s, double *z, const int64_t *sizes);

/* Copy what later steps need of a state; the rest of `kept` stays as it is. */
typedef int32_t KernelCopy(const double *p, const double *s, double *kept, const int64_t *sizes);

/* What changes z for a change of inputs over a step of h. Behind the inputs u is their change, behind the
 * copy s of the state room for another; both are spoilt. */
typedef int32_t KernelDerivative(
    const double *p, double *u, double *s, double *z, double *w, const int64_t *sizes, double h);

typedef struct Kernels {
    KernelInit *init;
    KernelStep *step;
    KernelDerivative *derivative;
    KernelOutputs *outputs;
    KernelCopy *copy;
} Kernels;

/* The kernels for this processor and a model with the parameters p, or NULL with the reason; FMU_BEARING_ISA=v2
 * takes v2 where it is there. */
const Kernels *kernels_choose(const double *p, Text *why);

#endif
