/* Kernels of a toy model with the entries of the real ones; ISA is the suffix, MARK a number it shows.
 *
 * p: tolerance, gain.  u: speed, load, trouble (status of a step), no_start (status of a start).
 * s: integral of the speed, time, speed reached, steps, load held.
 * z: gain * integral, load held, steps, MARK, margin (100 - load), speed reached, hidden. */
#include <math.h>
#include <stdint.h>
#include <string.h>

#define JOIN(a, b) a##b
#define NAME(a, b) JOIN(a, b)

int32_t NAME(fb_outputs_, ISA)(const double *p, const double *s, double *z, const int64_t *sizes);
int32_t NAME(fb_copy_, ISA)(const double *p, const double *s, double *kept, const int64_t *sizes);
int32_t NAME(fb_init_, ISA)(const double *p, const double *u, double *s, double *z, double *w,
                            const int64_t *sizes, double time);
int32_t NAME(fb_step_, ISA)(const double *p, const double *u, double *s, double *z, double *w,
                            const int64_t *sizes, double h);
int32_t NAME(fb_derivative_, ISA)(const double *p, const double *u, double *s, double *z, double *w,
                                  const int64_t *sizes, double h);

/* Fill the outputs. */
int32_t NAME(fb_outputs_, ISA)(const double *p, const double *s, double *z, const int64_t *sizes)
{
    z[0] = p[1] * s[0];
    z[1] = s[4];
    z[2] = s[3];
    z[3] = MARK;
    z[4] = 100.0 - s[4];
    z[5] = s[2];
    z[6] = (double)(sizes[0] + sizes[1] + sizes[2] + sizes[3] + sizes[4]);
    return 0;
}

/* Start at rest of the integral. */
int32_t NAME(fb_init_, ISA)(const double *p, const double *u, double *s, double *z, double *w,
                            const int64_t *sizes, double time)
{
    w[0] = time;
    if (u[3] != 0.0) return (int32_t)u[3];
    s[0] += 1.0; /* shows whether the state was empty before */
    s[1] = time;
    s[2] = u[0];
    s[4] = u[1];
    return NAME(fb_outputs_, ISA)(p, s, z, sizes);
}

/* Integrate the speed, which ramps to its input; in trouble stop at half of the step. */
int32_t NAME(fb_step_, ISA)(const double *p, const double *u, double *s, double *z, double *w,
                            const int64_t *sizes, double h)
{
    w[0] = h;
    s[0] += 0.5 * (s[2] + u[0]) * h;
    s[2] = u[0];
    s[3] += 1.0;
    s[4] = u[1];
    if (u[2] != 0.0 && h > 1e-3) {
        s[1] += 0.5 * h;
        return (int32_t)u[2];
    }
    s[1] += h;
    return NAME(fb_outputs_, ISA)(p, s, z, sizes);
}

/* The first two outputs change by twice what the first input changes by, plus h. */
int32_t NAME(fb_derivative_, ISA)(const double *p, const double *u, double *s, double *z, double *w,
                                  const int64_t *sizes, double h)
{
    (void)p;
    s[0] = w[0] = -1.0; /* a copy and scratch */
    z[0] = z[1] = 2.0 * u[0] + h;
    z[5] = NAN; /* not known */
    return sizes[0] > 0 ? 0 : 1;
}

/* Copy the state. */
int32_t NAME(fb_copy_, ISA)(const double *p, const double *s, double *kept, const int64_t *sizes)
{
    (void)p;
    memcpy(kept, s, (size_t)sizes[2] * sizeof *s);
    return 0;
}
