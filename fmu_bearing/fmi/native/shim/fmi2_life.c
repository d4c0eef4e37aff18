/* FMI 2.0: from instantiation to the end, and the log. */
#include "calls.h"

#include "fmi2Functions.h"

#include <math.h>
#include <string.h>

/* Types of the headers this library was made with. */
const char *fmi2GetTypesPlatform(void)
{
    return fmi2TypesPlatform;
}

/* Version of FMI. */
const char *fmi2GetVersion(void)
{
    return fmi2Version;
}

/* Whether the GUID the master read is that of the model. */
static int guid_matches(const Model *model, const char *guid, Text *why)
{
    const char *own = model_text(model, model->head->guid);
    if (guid && strcmp(guid, own) == 0) return 1;
    text_add(why, "wrong GUID: the host asks for ", guid ? guid : "(null)", ", the model in the resources is ", own,
             "; modelDescription.xml and resources belong to different FMUs", NULL);
    return 0;
}

/* Make an instance; NULL with the reason in the log. */
fmi2Component fmi2Instantiate(fmi2String name, fmi2Type type, fmi2String guid, fmi2String location,
                              const fmi2CallbackFunctions *functions, fmi2Boolean visible, fmi2Boolean logging)
{
    Log log = {0};
    Text why = {0}, said = {0};
    Instance *it = NULL;
    Model model;
    (void)visible;
    if (!functions) return NULL;
    log.logger = functions->logger;
    log.environment = functions->componentEnvironment;
    log.name = name ? name : "";
    log.enabled = logging ? UINT32_MAX : 0;
    if (type != fmi2CoSimulation) {
        text_add(&why, "this FMU is for co-simulation, not for model exchange", NULL);
    } else if (model_read(&model, location, FB_KERNELS, &why)) {
        if (guid_matches(&model, guid, &why)) it = instance_new(&model, &log, &why);
        if (!it) model_free(&model);
    }
    if (!it) {
        text_add(&said, "cannot instantiate: ", text_string(&why), NULL);
        log_say(&log, fmi2Error, &said);
    }
    text_free(&why);
    text_free(&said);
    return it;
}

/* Give all memory back. */
void fmi2FreeInstance(fmi2Component c)
{
    instance_free(c);
}

/* Choose what is logged. */
fmi2Status fmi2SetDebugLogging(fmi2Component c, fmi2Boolean on, size_t count, const fmi2String names[])
{
    Instance *it = c;
    Text why = {0};
    if (!call_allowed(it, CALL_SET_DEBUG_LOGGING)) return call_refused(it, CALL_SET_DEBUG_LOGGING);
    if (log_enable(&it->log, on, count, names, &why)) return fmi2OK;
    return instance_refuse(it, fmi2Error, &why); /* of no consequence for the model: it goes on */
}

/* Take the tolerance of the experiment, which wins over the parameter. There are masters that always pass
 * one, whatever the model: beyond its range it counts as the bound. */
static fmi2Status take_tolerance(Instance *it, double tolerance)
{
    uint64_t reference = it->model.head->tolerance;
    const ModelVariable *variable;
    double taken;
    Text text = {0};
    if (reference == MODEL_NOWHERE) return fmi2OK;
    variable = &it->model.variables[reference];
    text_add(&text, "the experiment's tolerance ", NULL);
    text_add_number(&text, tolerance, 0);
    if (!isfinite(tolerance)) {
        text_add(&text, " is not a finite number", NULL);
        return instance_fail(it, &text);
    }
    taken = tolerance < variable->min ? variable->min : tolerance > variable->max ? variable->max : tolerance;
    *it->slots[reference].at = taken;
    if (taken == tolerance) {
        text_free(&text);
        return fmi2OK;
    }
    text_add(&text, " is taken as ", NULL);
    text_add_number(&text, taken, 0);
    text_add(&text, ": allowed are ", NULL);
    text_add_number(&text, variable->min, 6);
    text_add(&text, " to ", NULL);
    text_add_number(&text, variable->max, 6);
    instance_refuse(it, fmi2Warning, &text); /* said, not answered: some masters go on after fmi2OK alone */
    return fmi2OK;
}

/* Take start time and tolerance; the stop time does not matter to the model. */
fmi2Status fmi2SetupExperiment(fmi2Component c, fmi2Boolean has_tolerance, fmi2Real tolerance, fmi2Real start,
                               fmi2Boolean has_stop, fmi2Real stop)
{
    Instance *it = c;
    (void)has_stop;
    (void)stop;
    if (!call_allowed(it, CALL_SETUP_EXPERIMENT)) return call_refused(it, CALL_SETUP_EXPERIMENT);
    if (!isfinite(start)) {
        Text text = {0};
        text_add(&text, "start time ", NULL);
        text_add_number(&text, start, 0);
        text_add(&text, " s is not a finite number", NULL);
        return instance_fail(it, &text);
    }
    it->time = it->reached = start;
    return has_tolerance ? take_tolerance(it, tolerance) : fmi2OK;
}

/* Begin to initialise. */
fmi2Status fmi2EnterInitializationMode(fmi2Component c)
{
    Instance *it = c;
    if (!call_allowed(it, CALL_ENTER_INITIALISATION)) return call_refused(it, CALL_ENTER_INITIALISATION);
    it->phase = PHASE_INITIALISING;
    return fmi2OK;
}

/* Settle the state at the inputs' values. */
fmi2Status fmi2ExitInitializationMode(fmi2Component c)
{
    Instance *it = c;
    fmi2Status status;
    if (!call_allowed(it, CALL_EXIT_INITIALISATION)) return call_refused(it, CALL_EXIT_INITIALISATION);
    status = instance_settle(it, fmi2Error);
    it->phase = status == fmi2OK ? PHASE_STEPPING : PHASE_FAILED;
    return status;
}

/* End stepping; values can still be read. */
fmi2Status fmi2Terminate(fmi2Component c)
{
    Instance *it = c;
    if (!call_allowed(it, CALL_TERMINATE)) return call_refused(it, CALL_TERMINATE);
    it->phase = PHASE_TERMINATED;
    return fmi2OK;
}

/* Back to what a fresh instance is. */
fmi2Status fmi2Reset(fmi2Component c)
{
    Instance *it = c;
    if (!call_allowed(it, CALL_RESET)) return call_refused(it, CALL_RESET);
    instance_reset(it);
    return fmi2OK;
}
