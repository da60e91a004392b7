// SPDX-License-Identifier: Apache-2.0
// theatron join with a window: the loop around a viewer.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "base/error.h"
#include "viewer/viewer.h"
#include "visit/stay.h"
#include "window/desktop_window_native.h"
#include "window_watch.h"

namespace theatron::app {

struct ViewerWindow {
    client::Participant::Options join;
    visit::Ports ports;
    WindowWatch* watch = nullptr;  // of the window; may be null
    viewer::Viewer::Options viewer;
    visit::KeptSettings settings;
    // Called once the host has let the person in, with the session's name.
    std::function<void(const std::string& session)> entered;
    std::string greeting;                 // shown for some seconds after the first picture
    std::filesystem::path save_to = ".";  // the folder of saved pictures and points
    double seconds = 0;                   // end this long after the first picture; 0: never
    bool is_last = true;                  // the program ends with this session
};

// True where a desktop is named by the environment; a window may still fail to open there.
bool has_display();

// The quality that "low" or "high" names; none for "auto".
std::optional<render::SceneQuality> parse_quality(const std::string& text);

// The window begins with the settings that the last one ended with, and keeps changes. `name`,
// `renderer` and `quality` of the command line come first, and are kept, too. Throws Error if there
// is no such renderer.
void use_kept_settings(ViewerWindow& window, const std::optional<std::string>& name,
                       const std::optional<std::string>& renderer,
                       const std::optional<std::string>& quality);

enum class WindowEnd {
    left,    // the person left the session
    closed,  // the person closed the window, or the program must end
};

// The session is over for this person, for good; with the reason as a sentence.
class SessionEnded : public Error {
public:
    using Error::Error;
};

// Throws Error if the host refused to let the person in, and SessionEnded if a session that the
// person was in is over: its last picture does not stay.
WindowEnd show(window::DesktopWindow& window, ViewerWindow options);

}  // namespace theatron::app
