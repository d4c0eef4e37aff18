#include "calls.h"

enum {
    ANY = PHASE_INSTANTIATED | PHASE_INITIALISING | PHASE_STEPPING | PHASE_TERMINATED | PHASE_FAILED,
    BEFORE_END = PHASE_INSTANTIATED | PHASE_INITIALISING | PHASE_STEPPING,
    AFTER_START = PHASE_STEPPING | PHASE_TERMINATED | PHASE_FAILED
};

/* In the order of Call. Values can be read in every phase: start values before, last ones after. */
const CallRule CALL_RULES[] = {
    {"setDebugLogging", ANY},
    {"setupExperiment", PHASE_INSTANTIATED},
    {"enterInitializationMode", PHASE_INSTANTIATED},
    {"exitInitializationMode", PHASE_INITIALISING},
    {"terminate", PHASE_STEPPING},
    {"reset", ANY},
    {"getting values", ANY},
    {"setting values", BEFORE_END},
    {"FMU state", ANY},
    {"getDirectionalDerivative", ANY},
    {"setRealInputDerivatives", BEFORE_END},
    {"getRealOutputDerivatives", AFTER_START},
    {"doStep", PHASE_STEPPING},
    {"getStatus", AFTER_START},
};

/* Where in its life an instance is, in words. */
static const char *phase_words(unsigned phase)
{
    switch (phase) {
    case PHASE_INSTANTIATED: return "before initialisation";
    case PHASE_INITIALISING: return "in initialisation";
    case PHASE_STEPPING: return "between steps";
    case PHASE_TERMINATED: return "after termination";
    default: return "after an error: only fmi2Reset or fmi2SetFMUstate leads on";
    }
}

/* Refuse a call that is out of order, or made on no instance. */
fmi2Status call_refused(Instance *it, Call call)
{
    Text text = {0};
    if (!it) return fmi2Error;
    text_add(&text, CALL_RULES[call].name, " called ", phase_words(it->phase), NULL);
    return instance_fail(it, &text);
}

/* Refuse a call whose argument of that name is NULL. */
fmi2Status call_lacks(Instance *it, Call call, const char *argument)
{
    Text text = {0};
    text_add(&text, CALL_RULES[call].name, ": the argument ", argument, " is NULL", NULL);
    return instance_fail(it, &text);
}
