// SPDX-License-Identifier: Apache-2.0
#include "capture/k4a_library.h"

#include <dlfcn.h>

#include <cstdlib>
#include <string>

#include "base/lasting_error.h"

namespace theatron::capture::k4a {
namespace {

// Version 1 of the interface, most specific name first. The last name is that of a development
// package or a build from source.
constexpr const char* usual_names[] = {"libk4a.so.1.4", "libk4a.so.1", "libk4a.so"};

std::string last_problem() {
    const char* problem = dlerror();
    return problem ? problem : "unknown reason";
}

template <class Function>
void find(void* library, const char* name, Function*& function) {
    function = reinterpret_cast<Function*>(dlsym(library, name));
    if (!function)
        throw LastingError("The camera library that was found lacks the function '" +
                           std::string(name) + "'; install libk4a 1.4 or Orbbec's K4A wrapper.");
}

void* open_any() {
    if (const char* chosen = std::getenv("THEATRON_K4A_LIBRARY")) {
        void* library = dlopen(chosen, RTLD_NOW | RTLD_LOCAL);
        if (!library)
            throw LastingError(
                "The camera library named by THEATRON_K4A_LIBRARY cannot be loaded: " +
                last_problem() + ".");
        return library;
    }
    // An installed library that lacks a dependency is reported rather than a missing one.
    std::string broken;
    for (const char* name : usual_names) {
        if (void* library = dlopen(name, RTLD_NOW | RTLD_LOCAL))
            return library;
        const std::string problem = last_problem();
        if (!problem.starts_with(name))
            broken = problem;
    }
    if (!broken.empty())
        throw LastingError("The camera library libk4a is there but cannot be loaded: " + broken +
                           ".");
    throw LastingError(
        "Live cameras need the library libk4a.so, which is not installed: install Microsoft's "
        "package libk4a1.4 for Azure Kinect, or Orbbec's K4A wrapper for Femto; a recording "
        "(mkv:FILE) or a synthetic camera works without it.");
}

}  // namespace

Library load_library() {
    void* library = open_any();
    Library functions;
#define THEATRON_K4A_FIND(type, name, arguments) find(library, "k4a_" #name, functions.name);
    THEATRON_K4A_FUNCTIONS(THEATRON_K4A_FIND)
#undef THEATRON_K4A_FIND
    return functions;
}

}  // namespace theatron::capture::k4a
