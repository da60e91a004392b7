// SPDX-License-Identifier: Apache-2.0
// The 2D view: one camera's colour as it is, for a computer that cannot draw the room, with what
// people point at and draw (flat_marks.h). No other camera comes. It needs no GL. People are heard
// and listed in a panel, where operators let in, mute and remove; one's own place in the room is
// told to nobody.
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "base/statistics.h"
#include "client/participant.h"
#include "flat_marks.h"
#include "viewer/facts.h"
#include "viewer/notice.h"
#include "viewer/removal_question.h"
#include "viewer/screen_offer.h"
#include "viewer/study_panel.h"

namespace theatron::web {

// For the page's one thread.
class FlatView {
public:
    // More pixels are left out: the canvas shows them anyway, and the computer is slow. Those of
    // screens have letters.
    static constexpr int most_flat_width = 640, most_screen_width = 1920;
    // As often as page/graphics.js asks for a picture.
    static constexpr double pictures_per_second = 5;
    // The host sends fewer frames, and then coarser ones, until they fit: five pictures a second of
    // 50 kB.
    static constexpr std::uint32_t most_kbit_per_s = 2000;
    // While the camera's depth comes, too: two or three of its lossless pictures more.
    static constexpr std::uint32_t most_kbit_per_s_with_depth = 5000;

    // How the participant joins.
    static client::Participant::Options options(client::Participant::Options join);

    // `participant` must outlive the view. `color`: the codec to ask for.
    FlatView(client::Participant& participant, std::string color)
        : participant_(participant), color_(std::move(color)), marks_(participant) {}

    void set_color(const std::string& codec) { color_ = codec; }
    // The camera after the present one; the first one with colour after the last. Its picture comes
    // soon.
    void next_camera();
    // Takes over new frames. True if the camera's picture is another one: see pixels(). Throws
    // Error if the host refused this participant.
    bool take(TimePoint now);
    // Red, green, blue and 255, row by row from above.
    const Bytes& pixels() const { return pixels_; }
    Size size() const { return size_; }

    // In the page's rhythm: takes what the person did. The result is that of
    // FlatMarks::take_drawing().
    std::string step(window::InputQueue& input, TimePoint now);

    void expect_pointing(bool expected) { marks_.expect_pointing(expected); }

    // Facts for the user, and the content of the panels without what only the room shows.
    viewer::Facts facts(TimePoint now);
    // A button of the panels that facts() gave last.
    void press(int command, TimePoint now);
    nlohmann::json state(const viewer::Facts& facts, const std::string& address) const;
    void note(const std::string& text, TimePoint now);

private:
    void follow_cameras();
    void ask();
    void show(const ColorImage& color, int most_width);
    void add_panels(viewer::Facts& facts, TimePoint now);
    void add_screens(const viewer::Facts& facts, viewer::RoomPanel& panel, TimePoint now);
    void on(const viewer::StudyPress& press, TimePoint now);
    void on(const viewer::ChooseTool& tool, TimePoint) { marks_.choose(tool.tool); }
    void on(const viewer::ChangeMarks& change, TimePoint now);
    void on(const viewer::Decide& decision, TimePoint now);
    void on(const viewer::ShowScreen& shown, TimePoint now);
    void on(const viewer::CloseScreenOffer& offer, TimePoint) { screen_offer_.close(offer.screen); }
    // Nothing has a button for the others.
    void on(const auto&, TimePoint) {}
    void show_marks();

    client::Participant& participant_;
    std::string color_;
    FlatMarks marks_;
    struct Seen {
        std::string name;
        bool is_screen = false;
        bool measures = false;  // depth that can be pointed at and drawn on
        Calibration calibration;
    };
    std::map<CameraId, Seen> seen_;   // the cameras with colour
    std::optional<CameraId> camera_;  // that is chosen
    // The last wish to the host, and its connection.
    struct Asked {
        int join = 0;
        CameraId camera{};
        std::string color;
        bool depth = false;
        bool operator==(const Asked&) const = default;
    };
    std::optional<Asked> asked_;
    // The picture; the camera that was chosen last may not have sent one yet.
    struct Shown {
        CameraId id{};
        std::string camera;
        TimePoint captured;
    };
    std::optional<Shown> shown_;
    Bytes pixels_;
    Size size_;
    std::uint64_t pictures_ = 0;
    RateWindow drawn_;
    std::vector<viewer::RoomCommand> commands_;  // of the panel's buttons
    viewer::ScreenOffer screen_offer_;
    viewer::RemovalQuestion removal_;
    viewer::StudyPanel study_;
    viewer::Notice notice_;
};

}  // namespace theatron::web
