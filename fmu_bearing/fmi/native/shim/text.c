#include "text.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_DIGITS = 17, NUMBER_SIZE = 400 };

/* Make room for so many more characters; 0 if there is none. */
static int reserve(Text *text, size_t more)
{
    size_t capacity = text->capacity ? text->capacity : 128;
    char *data;
    if (text->failed) return 0;
    while (capacity < text->length + more + 1) capacity *= 2;
    if (capacity == text->capacity) return 1;
    data = realloc(text->data, capacity);
    if (!data) {
        text->failed = 1;
        return 0;
    }
    text->data = data;
    text->capacity = capacity;
    return 1;
}

/* Append some bytes. */
void text_add_bytes(Text *text, const char *bytes, size_t count)
{
    if (!reserve(text, count)) return;
    if (count) memcpy(text->data + text->length, bytes, count);
    text->length += count;
    text->data[text->length] = '\0';
}

/* Append strings up to a NULL. */
void text_add(Text *text, const char *first, ...)
{
    const char *piece;
    va_list pieces;
    va_start(pieces, first);
    for (piece = first; piece; piece = va_arg(pieces, const char *)) text_add_bytes(text, piece, strlen(piece));
    va_end(pieces);
}

/* Raise the last digit of a number such as 1.25e+00; 0 if all its digits are nines. */
static int raise_last_digit(char *number)
{
    char *at = strchr(number, 'e');
    while (at && at > number) {
        at--;
        if (*at == '9') {
            *at = '0';
        } else if (*at >= '0' && *at <= '8') {
            ++*at;
            return 1;
        }
    }
    return 0;
}

/* Decimal digits of a positive number, and the power of ten of the first one, whatever the locale; whether
 * they read back as the number. Above a power of two lies twice the room of below it, so that the digits next
 * above may read back where the nearest do not. */
static int decimal(double value, int digits, char *found, int *exponent)
{
    char buffer[64];
    const char *at = buffer;
    int count = 0;
    int same;
    snprintf(buffer, sizeof buffer, "%.*e", digits - 1, value);
    same = strtod(buffer, NULL) == value;
    if (!same) {
        char above[sizeof buffer];
        memcpy(above, buffer, sizeof buffer);
        same = raise_last_digit(above) && strtod(above, NULL) == value;
        if (same) memcpy(buffer, above, sizeof buffer);
    }
    for (; *at && *at != 'e'; at++) {
        if (*at >= '0' && *at <= '9') found[count++] = *at;
    }
    *exponent = *at ? (int)strtol(at + 1, NULL, 10) : 0;
    return same;
}

/* Lay digits out as Python does: plain, or with an exponent where it is below -4 or beyond the limit. */
static void lay_out(Text *text, const char *digits, int count, int exponent, int limit)
{
    int plain = exponent >= -4 && exponent < limit;
    int point = plain ? exponent + 1 : 1; /* digits before the point */
    int i;
    if (point <= 0) {
        text_add(text, "0.", NULL);
        for (i = point; i < 0; i++) text_add(text, "0", NULL);
        text_add_bytes(text, digits, (size_t)count);
    } else {
        text_add_bytes(text, digits, (size_t)(count < point ? count : point));
        for (i = count; i < point; i++) text_add(text, "0", NULL);
        if (count > point) {
            text_add(text, ".", NULL);
            text_add_bytes(text, digits + point, (size_t)(count - point));
        }
    }
    if (!plain) {
        char power[16];
        snprintf(power, sizeof power, "e%c%02d", exponent < 0 ? '-' : '+', abs(exponent));
        text_add(text, power, NULL);
    } else if (limit == MOST_DIGITS - 1 && count <= point) {
        text_add(text, ".0", NULL);
    }
}

/* Append a number: shortest that reads back (0), or so many digits as %g. */
void text_add_number(Text *text, double value, int digits)
{
    char found[64] = "";
    int count = digits > 0 && digits < MOST_DIGITS ? digits : 1;
    int exponent = 0;
    if (isnan(value)) {
        text_add(text, "nan", NULL);
        return;
    }
    if (signbit(value)) text_add(text, "-", NULL);
    if (isinf(value)) {
        text_add(text, "inf", NULL);
        return;
    }
    value = fabs(value);
    while (!decimal(value, count, found, &exponent) && !digits && count < MOST_DIGITS) count++;
    while (count > 1 && found[count - 1] == '0') count--;
    lay_out(text, found, count, exponent, digits ? digits : MOST_DIGITS - 1);
}

/* Append a number with so many decimals. */
void text_add_fixed(Text *text, double value, int decimals)
{
    char buffer[NUMBER_SIZE];
    char *at;
    snprintf(buffer, sizeof buffer, "%.*f", decimals, value);
    for (at = buffer; *at; at++) {
        if (*at == ',') *at = '.'; /* some hosts set a locale */
    }
    text_add(text, buffer, NULL);
}

/* Append a whole number. */
void text_add_whole(Text *text, unsigned long long value)
{
    char buffer[32];
    char *at = buffer + sizeof buffer - 1;
    *at = '\0';
    do {
        *--at = (char)('0' + value % 10);
        value /= 10;
    } while (value);
    text_add(text, at, NULL);
}

/* The text as a string, never NULL. */
const char *text_string(const Text *text)
{
    if (text->failed) return "no memory for a message";
    return text->data ? text->data : "";
}

/* Give the memory back. */
void text_free(Text *text)
{
    free(text->data);
    memset(text, 0, sizeof *text);
}
