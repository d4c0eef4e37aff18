/* FMI 2.0: the state of an instance. A refusal here leaves the instance as it was. */
#include "calls.h"
#include "state.h"

#include "fmi2Functions.h"

#include <stdlib.h>
#include <string.h>

/* Refuse a call about states. */
static fmi2Status refuse(Instance *it, const char *reason)
{
    Text text = {0};
    text_add(&text, reason, NULL);
    return instance_refuse(it, fmi2Error, &text);
}

/* Keep the state aside; a block from an earlier call is used again. */
fmi2Status fmi2GetFMUstate(fmi2Component c, fmi2FMUstate *kept)
{
    Instance *it = c;
    Text why = {0};
    if (!call_allowed(it, CALL_STATE)) return call_refused(it, CALL_STATE);
    if (!kept) return refuse(it, "getFMUstate: the argument FMUstate is NULL");
    if (*kept && !state_belongs(it, *kept, &why)) return instance_refuse(it, fmi2Error, &why);
    if (*kept) {
        memset(*kept, 0, state_size(it));
    } else {
        *kept = calloc(1, state_size(it));
    }
    if (!*kept) return refuse(it, "getFMUstate: there is not enough memory for a state");
    state_take(it, *kept);
    return fmi2OK;
}

/* Go back to a state. */
fmi2Status fmi2SetFMUstate(fmi2Component c, fmi2FMUstate kept)
{
    Instance *it = c;
    Text why = {0};
    if (!call_allowed(it, CALL_STATE)) return call_refused(it, CALL_STATE);
    if (!kept) return refuse(it, "setFMUstate: state not taken: it is NULL");
    if (!state_belongs(it, kept, &why)) return instance_refuse(it, fmi2Error, &why);
    state_put_back(it, kept);
    return fmi2OK;
}

/* Give a state back. */
fmi2Status fmi2FreeFMUstate(fmi2Component c, fmi2FMUstate *kept)
{
    Instance *it = c;
    if (!call_allowed(it, CALL_STATE)) return call_refused(it, CALL_STATE);
    if (!kept || !*kept) return fmi2OK;
    free(*kept);
    *kept = NULL;
    return fmi2OK;
}

/* Bytes a state takes. */
fmi2Status fmi2SerializedFMUstateSize(fmi2Component c, fmi2FMUstate kept, size_t *size)
{
    Instance *it = c;
    Text why = {0};
    if (!call_allowed(it, CALL_STATE)) return call_refused(it, CALL_STATE);
    if (!kept || !size) return refuse(it, "serializedFMUstateSize: an argument is NULL");
    if (!state_belongs(it, kept, &why)) return instance_refuse(it, fmi2Error, &why);
    *size = state_size(it);
    return fmi2OK;
}

/* Write a state as bytes. */
fmi2Status fmi2SerializeFMUstate(fmi2Component c, fmi2FMUstate kept, fmi2Byte bytes[], size_t size)
{
    Instance *it = c;
    Text why = {0};
    State *state = kept;
    if (!call_allowed(it, CALL_STATE)) return call_refused(it, CALL_STATE);
    if (!kept || !bytes) return refuse(it, "serializeFMUstate: an argument is NULL");
    if (!state_belongs(it, kept, &why)) return instance_refuse(it, fmi2Error, &why);
    if (size < state_size(it)) return refuse(it, "serializeFMUstate: there is not enough room for the state");
    state_seal(state);
    memcpy(bytes, state, state_size(it));
    return fmi2OK;
}

/* Read a state from bytes. */
fmi2Status fmi2DeSerializeFMUstate(fmi2Component c, const fmi2Byte bytes[], size_t size, fmi2FMUstate *kept)
{
    Instance *it = c;
    Text why = {0};
    State *state;
    size_t known;
    if (!call_allowed(it, CALL_STATE)) return call_refused(it, CALL_STATE);
    if (!kept || !bytes) return refuse(it, "deSerializeFMUstate: an argument is NULL");
    *kept = NULL;
    state = calloc(1, state_size(it));
    if (!state) return refuse(it, "deSerializeFMUstate: there is not enough memory for a state");
    known = size < state_size(it) ? size : state_size(it);
    memcpy(state, bytes, known); /* the host's bytes need not be aligned */
    if (!state_is_whole(it, state, size, &why)) {
        free(state);
        return instance_refuse(it, fmi2Error, &why);
    }
    *kept = state;
    return fmi2OK;
}
