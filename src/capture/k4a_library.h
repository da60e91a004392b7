// SPDX-License-Identifier: Apache-2.0
// libk4a, loaded at run time, and its handles with owners.
#pragma once

#include <memory>

#include "capture/k4a_api.h"

namespace theatron::capture::k4a {

// The functions of the library. It stays loaded until the process ends, because its depth
// engine does not survive unloading.
struct Library {
// NOLINTNEXTLINE(bugprone-macro-parentheses): a declaration
#define THEATRON_K4A_MEMBER(type, name, arguments) type(*name) arguments = nullptr;
    THEATRON_K4A_FUNCTIONS(THEATRON_K4A_MEMBER)
#undef THEATRON_K4A_MEMBER
};

// Loads $THEATRON_K4A_LIBRARY or the installed library. Throws Error with what to install if
// there is none.
Library load_library();

// Releases a handle with the library's function for it.
template <class Handle>
struct GiveBack {
    void (*function)(Handle*) = nullptr;
    void operator()(Handle* handle) const { function(handle); }
};
using DevicePtr = std::unique_ptr<DeviceObject, GiveBack<DeviceObject>>;
using CapturePtr = std::unique_ptr<CaptureObject, GiveBack<CaptureObject>>;
using ImagePtr = std::unique_ptr<ImageObject, GiveBack<ImageObject>>;

}  // namespace theatron::capture::k4a
