/* Which call is allowed in which phase (FMI 2.0.5, section 4.2.4). */
#ifndef FB_CALLS_H
#define FB_CALLS_H

#include "instance.h"

typedef enum Call {
    CALL_SET_DEBUG_LOGGING,
    CALL_SETUP_EXPERIMENT,
    CALL_ENTER_INITIALISATION,
    CALL_EXIT_INITIALISATION,
    CALL_TERMINATE,
    CALL_RESET,
    CALL_GET,
    CALL_SET,
    CALL_STATE,
    CALL_DIRECTIONAL_DERIVATIVE,
    CALL_INPUT_DERIVATIVES,
    CALL_OUTPUT_DERIVATIVES,
    CALL_DO_STEP,
    CALL_STATUS
} Call;

typedef struct CallRule {
    const char *name;
    unsigned phases; /* bits of those in which it is allowed */
} CallRule;

extern const CallRule CALL_RULES[];

/* Whether a call is allowed now. */
static inline int call_allowed(const Instance *it, Call call)
{
    return it && (CALL_RULES[call].phases & it->phase);
}

/* Refuse a call that is out of order, or made on no instance. */
fmi2Status call_refused(Instance *it, Call call);

/* Refuse a call whose argument of that name is NULL. */
fmi2Status call_lacks(Instance *it, Call call, const char *argument);

#endif
