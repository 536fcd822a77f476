/* What the C programs of the tests share: a text, and a check that a call answers a status and says some words. */
#include "wearlaw_host.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static char text[600];
static int failures = 0, checks = 0;

#define TEXT text, sizeof text

/* Notes a call that answers otherwise, or whose text lacks `words`. */
#define EXPECT(status, words, call)                                                                                    \
    do {                                                                                                               \
        int32_t expect_found;                                                                                          \
        memset(text, 'x', sizeof text - 1);                                                                            \
        expect_found = (call);                                                                                         \
        ++checks;                                                                                                      \
        if (expect_found != (status) || !strstr(text, words) || (expect_found == WL_OK && text[0])) {                  \
            printf("line %d: status %d, `%s`\n", __LINE__, (int)expect_found, text);                                   \
            ++failures;                                                                                                \
        }                                                                                                              \
    } while (0)

#define DONE(call) EXPECT(WL_OK, "", call)

#define TRUE(condition)                                                                                                \
    do {                                                                                                               \
        ++checks;                                                                                                      \
        if (!(condition)) {                                                                                            \
            printf("line %d: not so: %s\n", __LINE__, #condition);                                                     \
            ++failures;                                                                                                \
        }                                                                                                              \
    } while (0)

/* How many checks were made; 1 if one failed. */
static int ended(void) {
    printf("%d checks\n", checks);
    return failures > 0;
}
