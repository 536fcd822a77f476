/* probe_load.c: what loading, using and unloading a law does to the process around it. */
#include "probe.h"

#include <dirent.h>
#include <dlfcn.h>
#include <locale.h>
#include <pthread.h>
#include <signal.h>
#include <unistd.h>

extern char **environ;

/* What a law leaves alone. */
typedef struct surroundings {
    char directory[1024], locale[256], environment[16384], handlers[4096];
    int threads, children;
} surroundings;

static int entries_of(const char *path) {
    DIR *folder = opendir(path);
    int count = 0;
    for (struct dirent *entry; folder && (entry = readdir(folder));) {
        count += entry->d_name[0] != '.';
    }
    if (folder) {
        closedir(folder);
    }
    return count;
}

static int children(void) {
    char line[4096] = "";
    int count = 0;
    (void)snprintf(line, sizeof line, "/proc/self/task/%d/children", (int)getpid());
    FILE *file = fopen(line, "r");
    line[0] = '\0';
    if (file) {
        (void)!fgets(line, sizeof line, file);
        fclose(file);
    }
    for (const char *at = line; *at; ++at) {
        count += *at == ' ';
    }
    return count;
}

static void look(surroundings *s) {
    size_t length = 0;
    sigset_t blocked;
    memset(s, 0, sizeof *s);
    (void)!getcwd(s->directory, sizeof s->directory);
    (void)snprintf(s->locale, sizeof s->locale, "%s", setlocale(LC_ALL, NULL));
    for (char **one = environ; one && *one; ++one) {
        length += (size_t)snprintf(s->environment + length, sizeof s->environment - length, "%s\n", *one);
    }
    pthread_sigmask(SIG_SETMASK, NULL, &blocked);
    length = 0;
    for (int number = 1; number < 65; ++number) {
        struct sigaction action;
        if (sigaction(number, NULL, &action) == 0) {
            length += (size_t)snprintf(s->handlers + length, sizeof s->handlers - length, "%d %p %d\n", number,
                                       (void *)(uintptr_t)action.sa_handler, sigismember(&blocked, number));
        }
    }
    s->threads = entries_of("/proc/self/task");
    s->children = children();
}

static void compare(const char *check, const surroundings *before, const char *when) {
    surroundings after;
    look(&after);
    if (strcmp(check, "load/working-directory") == 0 && strcmp(before->directory, after.directory) != 0) {
        bad("the working directory is %s %s, and was %s", after.directory, when, before->directory);
    }
    if (strcmp(check, "load/locale") == 0 && strcmp(before->locale, after.locale) != 0) {
        bad("the locale is %s %s, and was %s", after.locale, when, before->locale);
    }
    if (strcmp(check, "load/environment") == 0 && strcmp(before->environment, after.environment) != 0) {
        bad("environment variables have changed %s", when);
    }
    if (strcmp(check, "load/signals") == 0 && strcmp(before->handlers, after.handlers) != 0) {
        bad("signal handlers or the signal mask have changed %s", when);
    }
    if (strcmp(check, "load/threads") == 0 && before->threads != after.threads) {
        bad("there are %d threads %s, and were %d", after.threads, when, before->threads);
    }
    if (strcmp(check, "load/threads") == 0 && before->children != after.children) {
        bad("there are %d child processes %s, and were %d", after.children, when, before->children);
    }
}

/* One life of a law, point by point compared; a law may have threads between create and destroy. */
static void live(const char *check, const char *path) {
    surroundings before;
    look(&before);
    law_handle *h = open_law(path);
    compare(check, &before, "after loading");
    void *instance = make_instance(h);
    int threads = strcmp(check, "load/threads") == 0;
    if (!threads) {
        compare(check, &before, "after create");
    }
    job *j = make_job(h, 100, 1);
    evaluate(h, instance, j, all_outputs(h));
    for (int f = 0; f < FIELDS; ++f) {
        if (j->field[f]) {
            j->field[f][0] = 0; /* a point without wear */
        }
    }
    evaluate(h, instance, j, 0);
    if (!threads) {
        compare(check, &before, "after evaluation");
    }
    end_instance(h, instance);
    usleep(20000); /* a thread that was joined may still be listed */
    compare(check, &before, "after destroy");
    dlclose(h->library);
    compare(check, &before, "after unloading");
}

static void *live_in_a_thread(void *path) {
    law_handle h;
    if (!try_open(path, &h)) {
        bad("the library does not load again, or its entry refuses then");
    }
    void *instance = make_instance(&h);
    evaluate(&h, instance, make_job(&h, 10, 1), all_outputs(&h));
    end_instance(&h, instance);
    dlclose(h.library);
    return NULL;
}

static void symbols(const char *path) {
    if (!dlopen(path, RTLD_NOW | RTLD_LOCAL)) {
        char *why = strdup(dlerror()); /* the next call forgets it */
        if (dlopen(path, RTLD_LAZY | RTLD_LOCAL)) {
            bad("%s", why);
        }
    }
}

int probe_load(const char *name, const char *path) {
    static const char *const kept[] = {"load/silent", "load/working-directory", "load/locale",
                                       "load/signals", "load/threads", "load/environment"};
    if (strcmp(name, "load/symbols") == 0) {
        symbols(path);
        return 1;
    }
    if (strcmp(name, "load/opens") == 0) {
        open_law(path);
        return 1;
    }
    if (strcmp(name, "load/twice") == 0) {
        for (int time = 0; time < 3; ++time) {
            pthread_t thread;
            pthread_create(&thread, NULL, live_in_a_thread, (void *)(uintptr_t)path);
            pthread_join(thread, NULL);
        }
        return 1;
    }
    for (size_t i = 0; i < sizeof kept / sizeof *kept; ++i) {
        if (strcmp(kept[i], name) == 0) {
            live(name, path);
            return 1;
        }
    }
    return 0;
}
