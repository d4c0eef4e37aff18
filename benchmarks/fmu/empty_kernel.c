/* Kernels that compute nothing: with them a step of the native build costs what the calls cost.
 *
 * Compiled once for each ISA, the suffix of the entries; s[0] is the time. */
#include <stdint.h>

#define JOIN(a, b) a##b
#define NAME(a, b) JOIN(a, b)

int32_t NAME(fb_init_, ISA)(const double *p, const double *u, double *s, double *z, double *w,
                            const int64_t *sizes, double time);
int32_t NAME(fb_step_, ISA)(const double *p, const double *u, double *s, double *z, double *w,
                            const int64_t *sizes, double h);
int32_t NAME(fb_derivative_, ISA)(const double *p, const double *u, double *s, double *z, double *w,
                                  const int64_t *sizes, double h);
int32_t NAME(fb_outputs_, ISA)(const double *p, const double *s, double *z, const int64_t *sizes);
int32_t NAME(fb_copy_, ISA)(const double *p, const double *s, double *kept, const int64_t *sizes);

/* Begin at a time. */
int32_t NAME(fb_init_, ISA)(const double *p, const double *u, double *s, double *z, double *w,
                            const int64_t *sizes, double time)
{
    (void)p, (void)u, (void)z, (void)w, (void)sizes;
    s[0] = time;
    return 0;
}

/* Let time pass. */
int32_t NAME(fb_step_, ISA)(const double *p, const double *u, double *s, double *z, double *w,
                            const int64_t *sizes, double h)
{
    (void)p, (void)u, (void)z, (void)w, (void)sizes;
    s[0] += h;
    return 0;
}

/* There is nothing to read. */
int32_t NAME(fb_outputs_, ISA)(const double *p, const double *s, double *z, const int64_t *sizes)
{
    (void)p, (void)s, (void)z, (void)sizes;
    return 0;
}

/* Nothing follows from anything. */
int32_t NAME(fb_derivative_, ISA)(const double *p, const double *u, double *s, double *z, double *w,
                                  const int64_t *sizes, double h)
{
    (void)p, (void)u, (void)s, (void)z, (void)w, (void)sizes, (void)h;
    return 0;
}

/* There is nothing to copy but the time. */
int32_t NAME(fb_copy_, ISA)(const double *p, const double *s, double *kept, const int64_t *sizes)
{
    (void)p, (void)sizes;
    kept[0] = s[0];
    return 0;
}
