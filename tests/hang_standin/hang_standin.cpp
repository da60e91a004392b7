// SPDX-License-Identifier: Apache-2.0
// Calls that never return: a library for LD_PRELOAD.
//
// HANG_STANDIN names what hangs, words with spaces between them:
//
//   join    the first thread waits for another one for ever, from SIGTERM on
//   sound   SDL opens no sound device, and does not come back
//   swap    SDL_GL_SwapWindow, while the file that HANG_STANDIN_FILE names is there
#ifndef _GNU_SOURCE
#define _GNU_SOURCE
#endif
#include <dlfcn.h>
#include <pthread.h>
#include <signal.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cstdlib>
#include <cstring>

#define EXPORTED extern "C" __attribute__((visibility("default")))

namespace {

bool hangs(const char* what) {
    const char* wanted = getenv("HANG_STANDIN");
    return wanted && strstr(wanted, what);
}

template <class Function>
Function next(const char* name) {
    return reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
}

volatile sig_atomic_t told = 0;
sighandler_t caught = SIG_DFL;

void note(int number) {
    told = 1;
    caught(number);
}

}  // namespace

EXPORTED sighandler_t signal(int number, sighandler_t handler) {
    const auto real = next<sighandler_t (*)(int, sighandler_t)>("signal");
    if (number != SIGTERM || handler == SIG_DFL || handler == SIG_IGN || !hangs("join"))
        return real(number, handler);
    caught = handler;
    return real(number, note);
}

EXPORTED int pthread_join(pthread_t thread, void** result) {
    while (told && hangs("join") && getpid() == syscall(SYS_gettid))
        usleep(10'000);
    return next<int (*)(pthread_t, void**)>("pthread_join")(thread, result);
}

EXPORTED unsigned SDL_OpenAudioDevice(const char* name, int captures, const void* wanted, void* got,
                                      int changes) {
    while (hangs("sound"))
        usleep(10'000);
    using Open = unsigned (*)(const char*, int, const void*, void*, int);
    return next<Open>("SDL_OpenAudioDevice")(name, captures, wanted, got, changes);
}

EXPORTED void SDL_GL_SwapWindow(void* window) {
    const char* file = getenv("HANG_STANDIN_FILE");
    while (file && hangs("swap") && access(file, F_OK) == 0)
        usleep(10'000);
    next<void (*)(void*)>("SDL_GL_SwapWindow")(window);
}
