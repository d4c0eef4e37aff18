/* What path.c uses of Windows, to see on any system which files it would open there. */
#ifndef WINDOWS_H
#define WINDOWS_H

#include <stddef.h>
#include <stdio.h>

typedef unsigned UINT, DWORD;

enum { CP_ACP = 0, CP_UTF8 = 65001, MB_ERR_INVALID_CHARS = 8 };

/* Turn a text of a code page into wide characters; returns how many, the final zero included, 0 on failure. */
int MultiByteToWideChar(UINT page, DWORD flags, const char *text, int length, wchar_t *wide, int size);

/* Open a file. */
FILE *_wfopen(const wchar_t *path, const wchar_t *mode);

#endif
