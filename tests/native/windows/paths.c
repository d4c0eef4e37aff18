/* paths LOCATION...: the files that Windows would be asked for, one a line; no file is ever there. */
#include "path.h"

#include <stdint.h>
#include <windows.h>

/* Next character of a text in UTF-8, of at most two bytes here; -1 if it is none. */
static long next_character(const unsigned char **text)
{
    long first = *(*text)++;
    if (first < 0x80) return first;
    if (first < 0xc2 || first > 0xdf || (**text & 0xc0) != 0x80) return -1;
    return (first & 0x1f) << 6 | (*(*text)++ & 0x3f);
}

/* UTF-8, or Latin-1 in place of the system's code page. */
int MultiByteToWideChar(UINT page, DWORD flags, const char *text, int length, wchar_t *wide, int size)
{
    const unsigned char *at = (const unsigned char *)text;
    int count = 0;
    long character = 1;
    (void)length;
    while (character != 0) {
        character = page == CP_UTF8 ? next_character(&at) : (long)*at++;
        if (character < 0 && (flags & MB_ERR_INVALID_CHARS)) return 0;
        if (wide && count < size) wide[count] = (wchar_t)character;
        count++;
    }
    return count;
}

/* Print the name. */
FILE *_wfopen(const wchar_t *path, const wchar_t *mode)
{
    (void)mode;
    for (; *path; path++) printf(*path < 0x80 ? "%c" : "<%x>", (unsigned)*path);
    printf("\n");
    return NULL;
}

/* Try the locations. */
int main(int argc, char **argv)
{
    int i;
    for (i = 1; i < argc; i++) {
        Text path = {0}, why = {0};
        path_open(argv[i], "model.bin", &path, &why);
        text_free(&path);
        text_free(&why);
    }
    return 0;
}
