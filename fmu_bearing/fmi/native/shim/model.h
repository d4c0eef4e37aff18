/* resources/model.bin: everything of a scene, so that one library serves every scene.
 *
 * Written by model_file.py; little-endian, every part a multiple of 8 bytes, in the order of the head,
 * parameters p, starts of the inputs u, variables, reasons, cautions, log categories, texts. A text is
 * named by its offset among the texts. */
#ifndef FB_MODEL_H
#define FB_MODEL_H

#include "digest.h"
#include "text.h"

#include <stdint.h>

#define MODEL_FILE "model.bin"
#define MODEL_NOWHERE UINT64_MAX

enum { TYPE_REAL, TYPE_INTEGER, TYPE_BOOLEAN, TYPE_STRING };
enum { CAUSALITY_INPUT, CAUSALITY_OUTPUT, CAUSALITY_LOCAL, CAUSALITY_PARAMETER };
enum { VARIABILITY_CONSTANT, VARIABILITY_FIXED, VARIABILITY_DISCRETE, VARIABILITY_CONTINUOUS,
       VARIABILITY_TUNABLE };
enum { ARRAY_NONE, ARRAY_U, ARRAY_Z, ARRAY_P };

typedef struct ModelHead {
    unsigned char magic[8];
    uint64_t version;
    unsigned char checksum[DIGEST_SIZE]; /* of all that follows */
    unsigned char kernels[DIGEST_SIZE];
    unsigned char fingerprint[DIGEST_SIZE];
    uint64_t n_p, n_u, n_s, n_z, n_w;
    uint64_t n_tunables; /* head of p that can be set */
    uint64_t time;       /* where in s the time is */
    uint64_t tolerance;  /* value reference, or MODEL_NOWHERE */
    uint64_t ramped;     /* input that the engine ramps over a step, the others being held; or MODEL_NOWHERE */
    uint64_t journal;    /* most steps, at least 1, that are repeated to go back behind a refused one ... */
    double journal_span; /* ... and the longest time (s) that they take together */
    uint64_t n_variables, n_reasons, n_cautions, n_categories, n_text;
    uint64_t guid;
    uint64_t led, n_led; /* inputs that are led to their values over a step; derivatives are by these */
} ModelHead;

/* A variable; its value reference is its place. Numbers of constants are in `value`. */
typedef struct ModelVariable {
    uint32_t type, causality, variability, array;
    uint32_t index, name, unit, text;
    double min, max, value;
} ModelVariable;

/* What a status of the kernels means. */
typedef struct ModelReason {
    uint32_t status, text;
} ModelReason;

/* A warning, given once, where a number of u or z is below the threshold, or `above` it: before,
 * scale * number, after. */
typedef struct ModelCaution {
    uint32_t index, before, after, decimals, array, above;
    double threshold, scale;
} ModelCaution;

/* A category of the log; messages of this fmi2Status belong to it. */
typedef struct ModelCategory {
    uint32_t name, status;
} ModelCategory;

typedef struct Model {
    ModelHead *head; /* begin of the one block of memory */
    double *p;
    const double *u;
    const ModelVariable *variables;
    const ModelReason *reasons;
    const ModelCaution *cautions;
    const ModelCategory *categories;
    const char *texts;
} Model;

/* Read the model beside the library; 0 with the reason if it is not there, damaged or of another library. */
int model_read(Model *model, const char *location, const char *kernels, Text *why);

/* Give the memory back. */
void model_free(Model *model);

/* A text of the model. */
const char *model_text(const Model *model, uint64_t offset);

/* Append what a status of the kernels means. */
void model_add_reason(const Model *model, int32_t status, Text *text);

#endif
