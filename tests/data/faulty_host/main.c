/*
 * main.c: faulty_host LIBRARY CHECK. Ends with 1 and says what is bad, with 0 if nothing was found, and with 2 if the
 * question makes no sense.
 *
 * The probe runs in a child, which may crash, hang or end; for some checks that is the fault itself.
 */
#include "probe.h"

#include <errno.h>
#include <signal.h>
#include <stdarg.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

enum { FOUND = 41, NOTHING = 42 };

static char *evidence; /* shared with the child */

_Noreturn void bad(const char *format, ...) {
    va_list values;
    va_start(values, format);
    (void)vsnprintf(evidence, 1000, format, values);
    va_end(values);
    _Exit(FOUND);
}

void note(const char *word) { strcpy(evidence, word); }

/* Checks whose fault is that the child does not come back, with the way in which it goes. */
static const struct {
    const char *check, *way;
} deadly[] = {{"load/opens", "any"},        {"load/twice", "any"},       {"faults/exit", "exit"},
              {"faults/abort", "abort"},    {"faults/exception", "exception"}, {"faults/hang", "hang"},
              {"faults/stack", "stack"},    {"faults/signal", "signal"}, {"batch/large", "signal"},
              {"memory/after", "signal"},   {"memory/before", "signal"}, {"memory/inputs", "signal"},
              {"memory/undeclared", "signal"}, {"memory/uses", "signal"}, {"memory/outputs", "signal"},
              {"state/start", "signal"},    {"descriptor/smaller-structs", "signal"},
              {"descriptor/larger-structs", "signal"}, {"descriptor/text", "abort"}, {"batch/empty", "signal"}};

static int run_probe(const char *check, const char *path) {
    return probe_load(check, path) || probe_float(check, path) || probe_faults(check, path) ||
           probe_descriptor(check, path) || probe_sizes(check, path) || probe_values(check, path) ||
           probe_purity(check, path) || probe_batch(check, path) || probe_memory(check, path) ||
           probe_state(check, path) || probe_physics(check, path) || probe_units(check, path) ||
           probe_expected(check, path);
}

/* Waits for the child; kills it and everything it started when its time is over. Answers whether it hung. */
static int wait_for(pid_t child, const char *check, int *status) {
    /* Where a hang is the fault, little else is done; elsewhere a busy machine must not look like one. */
    int short_one = strcmp(check, "faults/hang") == 0 || strcmp(check, "load/opens") == 0;
    for (int hundredths = 0; hundredths < (short_one ? 800 : 12000); ++hundredths) {
        struct timespec hundredth = {0, 10000000};
        if (waitpid(child, status, WNOHANG) == child) {
            return 0;
        }
        nanosleep(&hundredth, NULL);
    }
    kill(child, SIGKILL);
    waitpid(child, status, 0);
    return 1;
}

/* Ends what a probed law has left: its orphans are children of this process, which is their reaper. */
static void end_orphans(void) {
    char path[64], line[4096] = "";
    (void)snprintf(path, sizeof path, "/proc/self/task/%d/children", (int)getpid());
    FILE *file = fopen(path, "r");
    if (file && fgets(line, sizeof line, file)) {
        for (char *at = strtok(line, " "); at; at = strtok(NULL, " ")) {
            kill((pid_t)atoi(at), SIGKILL);
        }
    }
    if (file) {
        fclose(file);
    }
    while (waitpid(-1, NULL, 0) > 0 || errno == EINTR) {
    }
}

int main(int argc, char **argv) {
    char output[8192] = "", *way;
    FILE *caught = tmpfile();
    size_t length;
    int status, hung;
    pid_t child;
    if (argc == 4 && strcmp(argv[2], "--fingerprint") == 0) { /* for a comparison between processes */
        law_handle *h = open_law(argv[1]);
        printf("%016llx\n", (unsigned long long)fingerprint(
                                h, evaluate(h, make_instance(h), make_job(h, 50, 7), all_outputs(h)), 50));
        return 0;
    }
    if (argc != 3 || !caught) {
        fprintf(stderr, "usage: faulty_host LIBRARY CHECK\n");
        return 2;
    }
    evidence = mmap(NULL, 4096, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    prctl(PR_SET_CHILD_SUBREAPER, 1);
    child = fork();
    if (child == 0) {
        dup2(fileno(caught), 1);
        dup2(fileno(caught), 2);
        setenv("PROBE_ITSELF", argv[0], 1);
        _Exit(run_probe(argv[2], argv[1]) ? NOTHING : 43);
    }
    hung = wait_for(child, argv[2], &status);
    end_orphans();
    rewind(caught);
    length = fread(output, 1, sizeof output - 1, caught);
    output[length] = '\0';
    if (WIFEXITED(status) && WEXITSTATUS(status) == FOUND) {
        printf("%s\n", evidence);
        return 1;
    }
    if (WIFEXITED(status) && WEXITSTATUS(status) == NOTHING) {
        if (strcmp(argv[2], "load/silent") == 0 && length > 0) {
            printf("printed: %s", output);
            return 1;
        }
        printf("nothing found\n");
        return 0;
    }
    if (WIFEXITED(status) && (WEXITSTATUS(status) == 2 || WEXITSTATUS(status) == 43)) {
        fprintf(stderr, "%s\n", WEXITSTATUS(status) == 2 ? output : "there is no probe for that check");
        return 2;
    }
    int thrown = strstr(output, "terminate called") || strstr(output, "panicked at");
    way = hung                                                          ? "hang"
          : WIFEXITED(status)                                           ? "exit"
          : WTERMSIG(status) == SIGABRT && thrown                       ? "exception"
          : WTERMSIG(status) == SIGABRT                                 ? "abort"
          : strncmp(evidence, "stack", 5) == 0                          ? "stack"
                                                                        : "signal";
    for (size_t i = 0; i < sizeof deadly / sizeof *deadly; ++i) {
        if (strcmp(deadly[i].check, argv[2]) == 0 &&
            (strcmp(deadly[i].way, way) == 0 || strcmp(deadly[i].way, "any") == 0)) {
            printf("ended by %s (%d): %s %s\n", way, WIFEXITED(status) ? WEXITSTATUS(status) : WTERMSIG(status),
                   evidence, output);
            return 1;
        }
    }
    fprintf(stderr, "the probe of %s ended by %s (%d): %s %s\n", argv[2], way,
            WIFEXITED(status) ? WEXITSTATUS(status) : WTERMSIG(status), evidence, output);
    return 2;
}
