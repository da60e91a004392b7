// SPDX-License-Identifier: Apache-2.0
#include "or_screen_window.h"

#include <nlohmann/json.hpp>
#include <utility>

#include "base/error.h"
#include "base/log.h"
#include "base/steady_clock.h"
#include "cli/stop_signal.h"
#include "files/png_file.h"
#include "link_argument.h"
#include "phrases/phrase.h"
#include "render/render_target.h"
#include "window_watch.h"

namespace theatron::app {
namespace {

// After the end of a session, and after a refusal.
constexpr Duration again_after = std::chrono::seconds(10);
constexpr Duration file_again_after = std::chrono::seconds(2);
constexpr Duration step_interval = std::chrono::milliseconds(250);

class Loop {
public:
    Loop(window::DesktopWindow& window, OrScreenWindow& options)
        : window_(window), watch_(window), options_(options), began_(steady_now()) {}

    bool is_over() const {
        return closed_ || cli::stop_requested() ||
               (options_.seconds > 0 &&
                steady_now() - began_ >= seconds_to_duration(options_.seconds));
    }

    // Until a session has been over for a while.
    void show_session(const net::Link& link) {
        client::Participant::Options join = options_.join;
        join.link = link;
        join.news = [this] { window_.wake(); };
        or_screen::OrScreen screen;
        visit::Stay stay(std::move(join), {.voice = &options_.voice});
        client::Participant& participant = stay.participant();
        std::optional<TimePoint> ended;
        TimePoint next{};
        watch_.rest();
        while (!is_over()) {
            const TimePoint now = wait_until(next);
            if (screen.has_picture())
                watch_.beat();
            const auto phase = participant.status().phase;
            using Phase = client::Participant::Phase;
            (void)stay.tick(now);
            if (phase == Phase::ended || phase == Phase::refused) {
                if (!ended)
                    ended = now;
                if (now - *ended >= again_after)
                    return;
            }
            if (now < next)
                continue;
            next = now + window_.picture_time();
            const bool changed =
                screen.step(participant, options_.voice.speaking(), window_.pixels(), now);
            if ((!changed && !std::exchange(redraw_, false)) || !window_.is_visible())
                continue;
            screen.draw({0, 0, 0, window_.pixels()}, now);
            window_.present();
            const TimePoint shown = steady_now();
            screen.on_drawn(shown - now, shown);
        }
        cli::begin_end();
    }

    // For a while.
    void show_problem(const std::string& problem) {
        or_screen::Drawing drawing;
        or_screen::Content content;
        content.message = say(Phrase::screen_waits_for_link);
        content.detail = say(Phrase::screen_tries_again, problem);
        const TimePoint end = steady_now() + file_again_after;
        while (!is_over() && steady_now() < end) {
            const TimePoint now = wait_until(steady_now() + step_interval);
            const Size size = window_.pixels();
            const auto layout = or_screen::layout({size, {}, 0, false});
            const Vec2 by = or_screen::drift(now);
            drawing.draw(content, layout, {by.x * layout.letter, by.y * layout.letter}, {},
                         {0, 0, 0, size});
            window_.present();
        }
    }

private:
    TimePoint wait_until(TimePoint next) {
        const TimePoint now = steady_now();
        window_.wait(next > now ? next - now : step_interval);
        const window::WindowInput input = window_.poll();
        closed_ = closed_ || input.close;
        redraw_ = redraw_ || input.redraw;
        return steady_now();
    }

    window::DesktopWindow& window_;
    WindowWatch watch_;
    OrScreenWindow& options_;
    const TimePoint began_;
    bool closed_ = false, redraw_ = true;
};

}  // namespace

void show_or_screen(window::DesktopWindow& window, OrScreenWindow options) {
    window.fill_screen();
    Loop loop(window, options);
    while (!loop.is_over()) {
        if (options.link_file.empty()) {
            loop.show_session(options.join.link);
            continue;
        }
        std::optional<net::Link> link;
        std::string problem;
        try {
            link = parse_link_argument(options.link_file);
        } catch (const Error& error) {
            problem = error.what();
        }
        if (link)
            loop.show_session(*link);
        else
            loop.show_problem(problem);
    }
}

OrScreenPicture::OrScreenPicture(Size size, std::string file, const visit::VoiceLine& voice)
    : size_(size), file_(std::move(file)), voice_(voice) {}

void OrScreenPicture::take(client::Participant& participant) {
    (void)screen_.step(participant, voice_.speaking(), size_, steady_now());
}

void OrScreenPicture::write() {
    if (!screen_.has_picture())
        throw Error("No picture came from the host, so none was written.");
    const render::RenderTarget target(size_);
    screen_.draw(target.target(), steady_now());
    const ColorImage picture = target.read().color;
    if (context_.errors() > 0)
        throw Error("The graphics driver reported an error: " + context_.first_error());
    files::write_png(file_, picture.view());
}

void OrScreenPicture::add_to(nlohmann::json& json) const {
    const or_screen::Content& content = screen_.content();
    nlohmann::json people = nlohmann::json::array(), pointers = nlohmann::json::array();
    for (const or_screen::PersonCard& card : content.people)
        people.push_back({{"id", std::uint32_t(card.id)},
                          {"name", card.name},
                          {"recorded", card.is_recorded},
                          {"state", card.state},
                          {"speaks", card.speaks}});
    for (const or_screen::PointerMark& pointer : content.pointers)
        pointers.push_back({{"id", std::uint32_t(pointer.id)},
                            {"sight", text_of(pointer.place.sight)},
                            {"x", pointer.place.pixel.x},
                            {"y", pointer.place.pixel.y}});
    json["or_screen"] = {{"camera", content.camera},
                         {"age", content.age},
                         {"warning", content.warning},
                         {"recording", content.playback},
                         {"message", content.message},
                         {"written", content.written},
                         {"people", people},
                         {"pointers", pointers},
                         {"marks", content.marks.size()},
                         {"slice", content.slice ? content.slice->plane : ""}};
    if (content.slice) {
        const medical::EdgeLetters& letters = content.slice->letters;
        json["or_screen"]["slice_letters"] = {letters.left, letters.right, letters.top,
                                              letters.bottom};
        json["or_screen"]["case"] = content.slice->case_name;
        json["or_screen"]["window"] = content.slice->window;
        json["or_screen"]["notice"] = content.slice->notice;
    }
}

}  // namespace theatron::app
