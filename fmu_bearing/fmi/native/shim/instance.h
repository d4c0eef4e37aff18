/* One bearing that runs: its arrays, its phase, and what every call does with them. */
#ifndef FB_INSTANCE_H
#define FB_INSTANCE_H

#include "kernels.h"
#include "log.h"
#include "model.h"

/* Phases in the life of an instance (FMI 2.0.5, section 4.2.4), one bit each. */
enum {
    PHASE_INSTANTIATED = 1,
    PHASE_INITIALISING = 2,
    PHASE_STEPPING = 4,
    PHASE_TERMINATED = 8,
    PHASE_FAILED = 16
};

/* Where the value of a variable is; NULL for strings. */
typedef struct Slot {
    double *at;
    unsigned char type, causality, computed, settable, fixed; /* fixed: once initialised */
} Slot;

typedef struct Instance {
    unsigned phase;
    int settled; /* the engine has been initialised at the present values */
    int rated;   /* some input has a rate */
    int early;   /* that outputs were read before initialisation was said */
    uint64_t warned; /* one bit per warning that was given */
    double refused; /* size of the step refused last, with nothing changed since (s); 0: none; infinite: any size */
    double time; /* reached by the master (s) */
    double reached, last_step; /* time the engine reached; step behind, 0 if there is none to look back on */
    KernelStep *step;
    const double *p;
    double *u, *s, *z, *w;
    int64_t sizes[5];
    size_t bytes_s, bytes_z;
    double *kept_s;  /* the state some steps ago: what steps need of it */
    double *journal; /* inputs and size of each step since, the present one included */
    uint64_t n_journal, most_journal;
    size_t entry_size;      /* numbers for one step in the journal */
    double span, most_span; /* time of the steps in the journal, and the longest (s) */
    int tracks;     /* outputs before the last step are kept from step to step, as someone asked for them */
    double *kept_z, *before_z; /* outputs before the present and before the last step */
    const double *engine_time;
    Slot *slots;
    uint64_t n_variables;
    double *waiting; /* for each input: a value out of range set before the end of initialisation, or NaN */
    uint64_t n_waiting;
    double *rates, *held, *tunables; /* rates of inputs, inputs over a ramped step, first values of p */
    const Kernels *kernels;
    char *name;
    double *memory;
    Model model;
    Log log;
} Instance;

/* Make an instance; NULL with the reason. The model stays the caller's where that fails. */
Instance *instance_new(Model *model, const Log *log, Text *why);

/* Give back all memory of an instance. */
void instance_free(Instance *it);

/* Back to what a fresh instance is; the log stays as it is set. */
void instance_reset(Instance *it);

/* Put the engine to its steady state at the values so far, once; fmi2OK, or `otherwise` said. */
fmi2Status instance_settle(Instance *it, fmi2Status otherwise);

/* Give the warnings about the state reached that were not given yet. */
void instance_warn(Instance *it);

/* Forget the state some steps ago: the present one did not come from it by steps. */
void instance_forget(Instance *it);

/* Fill the outputs before the last step, and keep them from now on. */
void instance_track(Instance *it);

/* Append "inputs were shaft_speed = ...". */
void instance_add_inputs(const Instance *it, Text *text);

/* Say why a call is refused, and return its status; the text is given back. */
fmi2Status instance_refuse(Instance *it, fmi2Status status, Text *text);

/* Note that a value was changed on which the answer to a step may depend. */
void instance_changed(Instance *it);

/* Say why a call is an error: nothing but reset or an earlier state helps then. Returns fmi2Error. */
fmi2Status instance_fail(Instance *it, Text *text);

/* Keep a value of an input that is out of its range, which has its start value until one in the range comes. */
void instance_keep_waiting(Instance *it, uint64_t reference, double value);

/* Note that an input has a value in its range: a step that waited for it is another one now. */
void instance_end_waiting(Instance *it, uint64_t reference);

/* Whether a variable may have a value; appends why not. */
int instance_may_have(const Instance *it, uint64_t reference, double value, Text *why);

#endif
