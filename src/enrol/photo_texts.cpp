// SPDX-License-Identifier: Apache-2.0
#include "enrol/photo_texts.h"

#include <string>
#include <utility>

#include "phrases/phrase.h"

namespace theatron::enrol {
namespace {

using Step = PhotoGuide::Step;
using Place = face::LandmarkDraft::Place;

struct EmotionTexts {
    Phrase name, act;
};

EmotionTexts texts_of(face::Emotion emotion) {
    switch (emotion) {
        case face::Emotion::sadness:
            return {Phrase::enrol_sadness, Phrase::enrol_act_sadness};
        case face::Emotion::disgust:
            return {Phrase::enrol_disgust, Phrase::enrol_act_disgust};
        case face::Emotion::happiness:
            return {Phrase::enrol_happiness, Phrase::enrol_act_happiness};
        case face::Emotion::surprise:
            return {Phrase::enrol_surprise, Phrase::enrol_act_surprise};
        case face::Emotion::anger:
            return {Phrase::enrol_anger, Phrase::enrol_act_anger};
        case face::Emotion::neutral:
            break;
    }
    return {Phrase::enrol_neutral, Phrase::enrol_act_neutral};
}

Phrase name_of(Place place) {
    switch (place) {
        case Place::left_eye_outer:
            return Phrase::enrol_left_eye_outer;
        case Place::left_eye_inner:
            return Phrase::enrol_left_eye_inner;
        case Place::right_eye_inner:
            return Phrase::enrol_right_eye_inner;
        case Place::right_eye_outer:
            return Phrase::enrol_right_eye_outer;
        case Place::nose_tip:
            return Phrase::enrol_nose_tip;
        case Place::left_mouth_corner:
            return Phrase::enrol_left_mouth_corner;
        case Place::right_mouth_corner:
            return Phrase::enrol_right_mouth_corner;
        case Place::chin:
            break;
    }
    return Phrase::enrol_chin;
}

window::PanelRow marking(const PhotoGuide& guide) {
    using Search = PhotoGuide::Search;
    if (const auto place = guide.draft().next()) {
        const std::string found_none =
            guide.search() == Search::no_face ? say(Phrase::enrol_no_face) + ". " : "";
        return {say(Phrase::enrol_click, say(name_of(*place))),
                found_none +
                    say(Phrase::enrol_click_count, std::to_string(int(*place) + 1),
                        std::to_string(face::LandmarkDraft::place_count)) +
                    ". " + say(Phrase::enrol_zoom) + ". " + say(Phrase::enrol_cross),
                {}};
    }
    if (const auto fault = guide.fault())
        return {reason_of(*fault), say(Phrase::enrol_zoom), {}};
    const std::string several =
        guide.search() == Search::found_largest ? say(Phrase::enrol_several_faces) + ". " : "";
    return {say(Phrase::enrol_look_over), several + say(Phrase::enrol_zoom), {}};
}

window::PanelRow instruction(const PhotoGuide& guide, bool has_picture, TimePoint now) {
    switch (guide.step()) {
        case Step::look:
            if (!has_picture)
                return {say(Phrase::enrol_waiting), "", {}};
            return {say(texts_of(guide.emotion()).act), say(Phrase::enrol_light), {}};
        case Step::count:
            return {say(texts_of(guide.emotion()).act),
                    say(Phrase::enrol_in_seconds, std::to_string(guide.seconds_left(now))),
                    {}};
        case Step::find:
            return {say(Phrase::enrol_finding), "", {}};
        case Step::mark:
            return marking(guide);
        case Step::done:
            break;
    }
    return {say(Phrase::enrol_making), "", {}};
}

window::PanelButton button(Phrase label, GuideCommand command) {
    return {say(label), int(command)};
}

std::vector<window::PanelButton> buttons(const PhotoGuide& guide, bool has_picture) {
    if (guide.asks_finish())
        return {button(Phrase::enrol_finish_now, GuideCommand::finish),
                button(Phrase::enrol_keep_taking, GuideCommand::keep_taking)};
    std::vector<window::PanelButton> shown;
    if (guide.step() == Step::look && has_picture)
        shown.push_back(button(Phrase::enrol_take, GuideCommand::take));
    if (guide.step() == Step::count)
        shown.push_back(button(Phrase::enrol_stop, GuideCommand::stop));
    if (guide.can_go_on())
        shown.push_back(button(Phrase::enrol_keep, GuideCommand::keep));
    if (guide.cross_px())
        shown.push_back(button(Phrase::enrol_put, GuideCommand::put));
    if (guide.step() == Step::mark && guide.has_camera())
        shown.push_back(button(Phrase::enrol_again, GuideCommand::again));
    if (guide.step() == Step::mark)
        shown.push_back(button(Phrase::enrol_undo, GuideCommand::undo));
    return shown;
}

window::PanelRow question_of_finishing(const PhotoGuide& guide) {
    const std::vector<face::Emotion> missing = guide.missing();
    std::string names;
    for (const face::Emotion emotion : missing)
        names += (names.empty() ? "" : ", ") + say(texts_of(emotion).name);
    return {say(Phrase::enrol_finish_asked, std::to_string(guide.count() - missing.size()),
                std::to_string(guide.count())),
            say(Phrase::enrol_without_photo, names),
            {}};
}

// The rows below the buttons of this step: other ways to go on.
std::vector<window::PanelButton> ways(const PhotoGuide& guide) {
    std::vector<window::PanelButton> shown;
    if (guide.asks_finish())
        return shown;
    if (guide.can_go_back())
        shown.push_back(button(Phrase::enrol_back, GuideCommand::back));
    if (guide.can_leave_out())
        shown.push_back(button(Phrase::enrol_leave_out, GuideCommand::leave_out));
    if (guide.can_finish())
        shown.push_back(button(Phrase::enrol_finish, GuideCommand::ask_finish));
    return shown;
}

}  // namespace

std::string reason_of(face::LandmarkFault fault) {
    switch (fault) {
        case face::LandmarkFault::outside:
            return say(Phrase::enrol_outside);
        case face::LandmarkFault::too_small:
            return say(Phrase::enrol_too_small);
        case face::LandmarkFault::upside_down:
            return say(Phrase::enrol_upside_down);
        case face::LandmarkFault::exchanged:
            return say(Phrase::enrol_exchanged);
        case face::LandmarkFault::no_face:
            break;
    }
    return say(Phrase::enrol_not_as_a_face);
}

window::OverlayContent guide_content(const PhotoGuide& guide, bool has_picture, TimePoint now) {
    window::OverlayContent content;
    window::Panel panel;
    panel.large = true;
    panel.title = guide.step() == Step::done
                      ? say(Phrase::enrol_title)
                      : say(Phrase::enrol_photo_of, say(texts_of(guide.emotion()).name),
                            std::to_string(guide.index() + 1), std::to_string(guide.count()));
    panel.rows.push_back(guide.asks_finish() ? question_of_finishing(guide)
                                             : instruction(guide, has_picture, now));
    if (auto shown = buttons(guide, has_picture); !shown.empty())
        panel.rows.push_back({"", "", std::move(shown)});
    if (auto others = ways(guide); !others.empty()) {
        const std::string hint = guide.can_leave_out() ? say(Phrase::enrol_leave_out_hint) : "";
        panel.rows.push_back({"", hint, std::move(others)});
    }
    content.panels.push_back(std::move(panel));
    if (guide.step() == Step::count)
        content.notice = say(Phrase::enrol_in_seconds, std::to_string(guide.seconds_left(now)));
    return content;
}

std::optional<GuideCommand> usual_command(const PhotoGuide& guide, bool has_picture) {
    const auto shown = buttons(guide, has_picture);
    // Undo is no answer to a question.
    if (shown.empty() || shown[0].command == int(GuideCommand::undo) ||
        shown[0].command == int(GuideCommand::again))
        return std::nullopt;
    return GuideCommand(shown[0].command);
}

void obey(PhotoGuide& guide, GuideCommand command, TimePoint now) {
    switch (command) {
        case GuideCommand::take:
            return guide.take_photo(now);
        case GuideCommand::stop:
            return guide.stop_counting();
        case GuideCommand::again:
            return guide.take_again();
        case GuideCommand::keep:
            return guide.go_on();
        case GuideCommand::put:
            return guide.put_at_cross();
        case GuideCommand::undo:
            return guide.undo();
        case GuideCommand::back:
            return guide.go_back();
        case GuideCommand::leave_out:
            return guide.leave_out();
        case GuideCommand::ask_finish:
            return guide.ask_finish();
        case GuideCommand::finish:
            return guide.finish();
        case GuideCommand::keep_taking:
            return guide.keep_taking();
    }
}

}  // namespace theatron::enrol
