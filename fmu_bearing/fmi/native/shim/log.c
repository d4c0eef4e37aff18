#include "log.h"

#include <string.h>

/* Category of a status, by place; -1 if there is none. */
static int category_of(const Model *model, fmi2Status status)
{
    uint64_t i;
    for (i = 0; i < model->head->n_categories; i++) {
        if (model->categories[i].status == (uint32_t)status) return (int)i;
    }
    return -1;
}

/* Hand a message over as a format without arguments, every % doubled: hosts that cannot read arguments of
 * variable number, such as those in Python, would see no more than "%s" otherwise. Every # is doubled, too: a
 * single one begins a reference to a variable (FMI 2.0, section 2.1.5). */
static void send(const Log *log, fmi2Status status, const char *category, const char *message)
{
    Text format = {0};
    for (; *message; message++) {
        text_add_bytes(&format, message, 1);
        if (*message == '%' || *message == '#') text_add_bytes(&format, message, 1);
    }
    log->logger(log->environment, log->name, status, category, text_string(&format));
    text_free(&format);
}

/* Say something about a call with that status. */
void log_say(const Log *log, fmi2Status status, const Text *text)
{
    const char *name = "logStatusError";
    if (!log->logger) return;
    if (log->model) {
        int category = category_of(log->model, status);
        if (category < 0 || !(log->enabled >> category & 1U)) return;
        name = model_text(log->model, log->model->categories[category].name);
    }
    send(log, status, name, text_string(text));
}

/* Bit of a category by name; the one of fmi2OK, logAll, means all. 0: unknown. */
static uint32_t bits_of(const Model *model, const char *name)
{
    uint64_t i;
    for (i = 0; name && i < model->head->n_categories; i++) {
        const ModelCategory *category = &model->categories[i];
        if (strcmp(name, model_text(model, category->name)) == 0) {
            return category->status == fmi2OK ? UINT32_MAX : (uint32_t)1 << i;
        }
    }
    return 0;
}

/* Ask for all categories, for some, or for none. */
int log_enable(Log *log, int on, size_t count, const fmi2String *names, Text *why)
{
    uint32_t enabled = count ? 0 : UINT32_MAX;
    size_t i;
    if (count && !names) {
        text_add(why, "setDebugLogging: the list of categories is missing", NULL);
        return 0;
    }
    for (i = 0; i < count; i++) {
        uint32_t bits = bits_of(log->model, names[i]);
        if (!bits) {
            uint64_t k;
            text_add(why, "there is no log category ", names[i] ? names[i] : "(null)", "; there are", NULL);
            for (k = 0; k < log->model->head->n_categories; k++) {
                text_add(why, k ? ", " : " ", model_text(log->model, log->model->categories[k].name), NULL);
            }
            return 0;
        }
        enabled |= bits;
    }
    log->enabled = on ? enabled : 0;
    return 1;
}
