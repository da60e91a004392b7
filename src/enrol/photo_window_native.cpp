// SPDX-License-Identifier: Apache-2.0
#include "enrol/photo_window_native.h"

#include <cmath>
#include <future>
#include <string>
#include <utility>

#include "base/error.h"
#include "base/log.h"
#include "base/steady_clock.h"
#include "enrol/photo_canvas.h"
#include "enrol/photo_texts.h"
#include "phrases/phrase.h"
#include "visit/leaving.h"
#include "window/keyboard_focus.h"
#include "window/overlay_native.h"
#include "window/plain_picture_native.h"

namespace theatron::enrol {
namespace {

using Step = PhotoGuide::Step;

// The panel has the part of the window left of this share.
constexpr double panel_share = 0.36;
constexpr Duration idle = 100ms, camera_patience = 20ms;
constexpr double zoom_per_click = 1.25;

class PhotoLoop {
public:
    PhotoLoop(window::DesktopWindow& window, PhotoGuide guide,
              std::unique_ptr<capture::Camera> camera, const LandmarkFinder& finder)
        : window_(window),
          guide_(std::move(guide)),
          camera_(std::move(camera)),
          finder_(finder),
          problem_(finder.problem()) {}

    // False: the person ended it.
    bool run(const std::function<bool()>& stops) {
        window_.set_title(say(Phrase::enrol_title) + " - Theatron");
        while (!stops()) {
            const bool is_live = shows_camera();
            window_.wait(is_live ? Duration(0) : idle);
            const window::FormInput input = window_.poll_form();
            const TimePoint now = steady_now();
            if (input.close || !take(input, now))
                return false;
            if (is_live)
                look(now);
            find();
            const bool is_done = guide_.step() == Step::done;
            if (is_live || is_done || must_draw_ || !input.is_empty())
                draw(now);
            if (is_done)
                return true;
        }
        return false;
    }

    std::vector<Photo> take_photos() { return guide_.take_photos(); }

private:
    bool shows_camera() const {
        return guide_.step() == Step::look || guide_.step() == Step::count;
    }
    bool has_picture() const { return !live_.empty(); }
    ColorView shown_photo() const {
        return shows_camera() ? live_.view() : guide_.photo().picture.view();
    }

    void look(TimePoint now) {
        capture::Capture got = camera_->next(camera_patience);
        if (got.kind == capture::Capture::Kind::failed || got.kind == capture::Capture::Kind::end) {
            const std::string problem =
                got.problem.empty() ? "The camera gives no more pictures." : got.problem;
            if (!guide_.can_finish())
                throw Error(problem);
            // The photos that are there make a face.
            log::say(problem + " The face is made of the photos that were taken.");
            return guide_.finish();
        }
        if (got.kind != capture::Capture::Kind::frame)
            return;
        if (got.frame->color.pixels.empty())
            throw Error("This camera gives no pictures in which a face can be marked.");
        live_ = got.frame->color.pixels;
        guide_.on_picture(live_.view(), now);
    }

    // Landmarks are looked for beside the window's turns.
    void find() {
        const bool is_ready =
            search_.valid() && search_.wait_for(Duration(0)) == std::future_status::ready;
        if (is_ready) {
            const FoundLandmarks found = search_.get();
            // Another photo may have been taken meanwhile.
            if (searched_turn_ == guide_.turn())
                on_found(found);
        }
        if (guide_.step() != Step::find || search_.valid())
            return;
        if (!problem_.empty())
            return on_found({});  // nothing is looked for
        searched_turn_ = guide_.turn();
        search_ = std::async(std::launch::async, [this, photo = guide_.photo().picture] {
            return finder_.find(photo.view());
        });
        must_draw_ = true;
    }

    void on_found(const FoundLandmarks& found) {
        using Search = PhotoGuide::Search;
        guide_.on_found(found.landmarks_px, !found.is_searched ? Search::none
                                            : found.faces == 0 ? Search::no_face
                                            : found.faces == 1 ? Search::found
                                                               : Search::found_largest);
        must_draw_ = true;
    }

    // False: the person wants to end it.
    bool take(const window::FormInput& input, TimePoint now) {
        for (const window::FormKeyPress& press : input.keys)
            if (!take(press, now))
                return false;
        if (input.pointer)
            point(*input.pointer, input, now);
        if (!input.is_down)
            guide_.release();
        return true;
    }

    bool take(const window::FormKeyPress& press, TimePoint now) {
        using window::FocusStep, window::FormKey;
        const double step = press.shift ? 10 : 1;
        switch (press.key) {
            case FormKey::escape:
                if (leaving_.pressed(true, now))
                    return false;
                asked_leave_ = now;
                break;
            case FormKey::tab:
                focus_ =
                    window::moved_focus(focus_, press.shift ? FocusStep::previous : FocusStep::next,
                                        overlay_.controls());
                break;
            case FormKey::enter:
            case FormKey::space:
                if (focus_ && *focus_ < overlay_.controls())
                    obey(guide_, GuideCommand(overlay_.command_of(*focus_)), now);
                else if (const auto usual = usual_command(guide_, has_picture()))
                    obey(guide_, *usual, now);
                focus_.reset();
                break;
            case FormKey::backspace:
                guide_.undo();
                break;
            case FormKey::z:
                if (press.control)
                    guide_.undo();
                break;
            case FormKey::left:
                nudge({-step, 0});
                break;
            case FormKey::right:
                nudge({step, 0});
                break;
            case FormKey::up:
                nudge({0, -step});
                break;
            case FormKey::down:
                nudge({0, step});
                break;
            default:
                break;
        }
        return true;
    }

    // By pixels of the window.
    void nudge(Vec2 by) {
        if (place_)
            guide_.nudge({by.x / place_->scale(), by.y / place_->scale()});
    }

    void point(Vec2 share, const window::FormInput& input, TimePoint now) {
        const Size size = window_.pixels();
        const Vec2 at{share.x * size.width, share.y * size.height};
        if (const auto hovered = overlay_.control_at(share); hovered != hovered_) {
            hovered_ = hovered;
            must_draw_ = true;
        }
        if (overlay_.covers(share)) {
            if (const auto command = overlay_.command_at(share); command && input.clicked) {
                obey(guide_, GuideCommand(*command), now);
                focus_.reset();
            }
            return;
        }
        if (!place_ || guide_.step() != Step::mark)
            return;
        if (input.wheel != 0)
            place_->zoom(std::pow(zoom_per_click, input.wheel), at);
        if (input.clicked) {
            guide_.press(place_->photo_of(at), 0.6 * window_.text_pixels() / place_->scale());
        } else if (input.is_down) {
            guide_.drag(place_->photo_of(at));
            must_draw_ = true;
        }
    }

    void draw(TimePoint now) {
        must_draw_ = false;
        const Size size = window_.pixels();
        const ColorView photo = shown_photo();
        if (canvas_.size != size)
            canvas_ = ColorImage(size);
        if (photo.size.area() > 0) {
            // Another photo, or another window, is seen as a whole at first.
            if (!place_ || placed_size_ != size || placed_turn_ != guide_.turn() || shows_camera())
                place_.emplace(photo.size, size, panel_share * size.width);
            placed_size_ = size;
            placed_turn_ = guide_.turn();
            draw_photo(photo, *place_, shows_camera(), canvas_.view());
        } else {
            std::fill(canvas_.pixels.begin(), canvas_.pixels.end(), canvas_ground);
        }
        if (guide_.step() == Step::mark)
            draw_landmarks(guide_.draft(), guide_.chosen(), *place_, 0.14 * window_.text_pixels(),
                           canvas_.view());
        if (const auto cross = guide_.cross_px())
            draw_cross(place_->window_of(*cross), window_.text_pixels(), canvas_.view());
        picture_.show(canvas_.view(), size);
        window::OverlayContent content = guide_content(guide_, has_picture(), now);
        if (asked_leave_ && now - *asked_leave_ < visit::Leaving::confirm_within)
            content.notice = say(Phrase::enrol_leave_again);
        content.hovered = hovered_;
        content.focused = focus_;
        overlay_.draw(content, size, window_.text_pixels());
        window_.present();
    }

    window::DesktopWindow& window_;
    PhotoGuide guide_;
    const std::unique_ptr<capture::Camera> camera_;
    const LandmarkFinder& finder_;
    const std::string problem_;  // of the finder
    std::future<FoundLandmarks> search_;
    std::size_t searched_turn_ = 0;
    ColorImage live_, canvas_;
    std::optional<PhotoPlace> place_;
    Size placed_size_;
    std::size_t placed_turn_ = 0;
    window::PlainPicture picture_;
    window::Overlay overlay_;
    visit::Leaving leaving_;
    std::optional<TimePoint> asked_leave_;
    std::optional<std::size_t> focus_, hovered_;
    bool must_draw_ = true;
};

}  // namespace

std::optional<std::vector<Photo>> ask_photos(window::DesktopWindow& window, PhotoGuide guide,
                                             std::unique_ptr<capture::Camera> camera,
                                             const LandmarkFinder& finder,
                                             const std::function<bool()>& stops) {
    PhotoLoop loop(window, std::move(guide), std::move(camera), finder);
    if (!loop.run(stops))
        return std::nullopt;
    return loop.take_photos();
}

}  // namespace theatron::enrol
