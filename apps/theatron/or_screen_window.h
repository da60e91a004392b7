// SPDX-License-Identifier: Apache-2.0
// theatron join --or-screen: the loop around an or_screen::OrScreen, and its picture in a file.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "join_pictures.h"
#include "or_screen/or_screen.h"
#include "render/offscreen_context_native.h"
#include "visit/stay.h"
#include "window/desktop_window_native.h"

namespace theatron::app {

// The name of a screen that was given none.
inline constexpr const char* or_screen_name = "OR screen";

struct OrScreenWindow {
    std::string link_file;  // "@FILE", read again for every session; empty: join.link
    client::Participant::Options join;
    visit::VoiceLine& voice;  // its packets must come by `join`
    double seconds = 0;       // end this long after the beginning; 0: never
};

// Fills the screen until the window is closed or the program is stopped. After the end of a
// session, a refusal, or where the file of the link cannot be read, it tries again.
void show_or_screen(window::DesktopWindow& window, OrScreenWindow options);

class OrScreenPicture : public JoinPicture {
public:
    // `voice` must outlive it.
    OrScreenPicture(Size size, std::string file, const visit::VoiceLine& voice);
    void take(client::Participant& participant);
    void take(client::Participant& participant, RoomLines&) override { take(participant); }
    void write() override;
    // "or_screen": {"camera","age","warning","recording","message","people":[{"id","name",
    // "recorded","state","speaks"}],"pointers":[{"id","sight","x","y"}],"marks","slice"}; x and y
    // are pixels of the camera's picture
    void add_to(nlohmann::json& json) const override;
    bool has_picture() const { return screen_.has_picture(); }

private:
    const Size size_;
    const std::string file_;
    const visit::VoiceLine& voice_;
    render::OffscreenContext context_;
    or_screen::OrScreen screen_;
};

}  // namespace theatron::app
