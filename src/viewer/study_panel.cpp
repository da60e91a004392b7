// SPDX-License-Identifier: Apache-2.0
#include "viewer/study_panel.h"

#include <cstdlib>
#include <utility>

#include "phrases/phrase.h"

namespace theatron::viewer {
namespace {

using What = StudyPress::What;
using wire::StudyKind;

std::string seconds_text(Duration left) {
    constexpr Duration second = std::chrono::seconds(1);
    return std::to_string((left + second - Duration(1)) / second);
}

std::string marked(const std::string& label, bool is_chosen) {
    return is_chosen ? "[" + label + "]" : label;
}

}  // namespace

bool StudyPanel::take(const std::optional<client::Participant::Study>& study, TimePoint now) {
    if (!study) {
        step_.reset();
        version_ = 0;
        return false;
    }
    if (study->version == version_)
        return false;
    version_ = study->version;
    step_ = study->step;
    shown_ = now;
    sent_ = false;
    if (step_->kind == StudyKind::interrupted)
        return false;
    const std::pair now_shown{step_->step, step_->kind};
    const bool is_same = std::exchange(last_, now_shown) == now_shown;
    if (is_same && step_->problem.empty())  // told again: what the person has chosen stays
        return false;
    chosen_.reset();
    negative_ = types_ = aside_ = asks_end_ = false;
    return true;
}

bool StudyPanel::is_question() const {
    return step_->kind == StudyKind::consent || step_->kind >= StudyKind::number;
}

std::pair<int, int> StudyPanel::bounds() const {
    switch (step_->kind) {
        case StudyKind::consent:
        case StudyKind::yes_no:
            return {0, 1};
        case StudyKind::choice:
            return {1, int(step_->choices.size())};
        default:
            return {step_->lowest, step_->highest};
    }
}

bool StudyPanel::is_typed() const {
    return step_->kind == StudyKind::number ||
           (step_->kind == StudyKind::rating &&
            (std::int64_t(step_->highest) - step_->lowest) / step_->step_size >= most_points);
}

bool StudyPanel::types_digits() const {
    const auto [lowest, highest] = bounds();
    const bool has_points = step_->kind == StudyKind::rating || step_->kind == StudyKind::choice;
    return is_typed() || (has_points && (lowest < 0 || highest > 9));
}

void StudyPanel::type_digit(int digit) {
    constexpr int most_digits_value = 99'999;
    const auto [lowest, highest] = bounds();
    const bool has_one_digit = lowest >= -9 && highest <= 9;
    // A button was pressed before, or the reply has one digit: the number begins anew.
    if (!types_ || (has_one_digit && chosen_)) {
        negative_ = negative_ && !chosen_;
        chosen_.reset();
    }
    types_ = true;
    if (const int before = std::abs(chosen_.value_or(0)); before <= most_digits_value)
        chosen_ = (before * 10 + digit) * (negative_ ? -1 : 1);
}

bool StudyPanel::is_point(std::int64_t value) const {
    const auto [lowest, highest] = bounds();
    return value >= lowest && value <= highest &&
           (step_->kind != StudyKind::rating || (value - lowest) % step_->step_size == 0);
}

bool StudyPanel::takes_replies() const {
    return step_ && !aside_ && !sent_ && !asks_end_ && step_->kind != StudyKind::interrupted &&
           step_->kind != StudyKind::over;
}

bool StudyPanel::may_go_on(TimePoint now) const {
    if (is_question())
        return chosen_ && is_point(*chosen_);
    return step_->kind != StudyKind::watch || seen_for(now) >= step_->watch;
}

std::optional<wire::StudyReply> StudyPanel::carry_out(const StudyPress& press, TimePoint now) {
    // Keys, and buttons of a picture that is older than the reply.
    if (!step_ || (sent_ && press.what <= What::leave_out))
        return std::nullopt;
    using wire::StudyAction;
    const auto send = [&](StudyAction action, int value = 0) {
        sent_ = true;
        asks_end_ = false;
        return wire::StudyReply{step_->step, action, value};
    };
    switch (press.what) {
        case What::choose:
            if (!is_point(press.value))
                break;
            chosen_ = press.value;
            negative_ = press.value < 0;
            types_ = false;
            break;
        case What::digit:
            type_digit(press.value);
            break;
        case What::minus:
            negative_ = !negative_;
            if (chosen_)
                chosen_ = -*chosen_;
            break;
        case What::erase:
            if (!chosen_)
                negative_ = false;
            chosen_ =
                chosen_ && std::abs(*chosen_) >= 10 ? std::optional(*chosen_ / 10) : std::nullopt;
            break;
        case What::go_on:
            if (may_go_on(now))
                return send(StudyAction::answer, chosen_.value_or(0));
            break;
        case What::leave_out:
            return send(StudyAction::skip);
        case What::ask_end:
            asks_end_ = true;
            break;
        case What::end:
            return send(StudyAction::stop);
        case What::keep_on:
            asks_end_ = false;
            break;
        case What::aside:
            aside_ = true;
            break;
        case What::show:
            aside_ = false;
            break;
        case What::close:
            step_.reset();
            break;
    }
    return std::nullopt;
}

std::optional<StudyPress> StudyPanel::press_of(const StudyKey& key, TimePoint now) const {
    using Key = StudyKey::What;
    // A digit that comes twice, or is no point, must not move the person away from the question.
    if (step_ && sent_ && !aside_ && key.what == Key::digit)
        return StudyPress{What::choose, key.digit};
    if (!takes_replies())
        return std::nullopt;
    switch (key.what) {
        case Key::digit:
            if (types_digits())
                return StudyPress{What::digit, key.digit};
            if (step_->kind == StudyKind::rating || step_->kind == StudyKind::choice)
                return StudyPress{What::choose, key.digit};
            break;
        case Key::minus:
            if (types_digits() && bounds().first < 0)
                return StudyPress{What::minus};
            break;
        case Key::erase:
            if (types_digits())
                return StudyPress{What::erase};
            break;
        case Key::go_on:
            if (may_go_on(now))
                return StudyPress{What::go_on};
            break;
    }
    return std::nullopt;
}

void StudyPanel::add_texts(window::Panel& rows) const {
    for (const wire::StudyText& text : step_->texts)
        rows.rows.push_back({text.text, "", {}});
    if (!step_->problem.empty())
        rows.rows.push_back({step_->problem, "", {}});
}

window::PanelButton StudyPanel::answer(const std::string& label, int value,
                                       RoomPanel& panel) const {
    return panel.button(marked(label, chosen_ == value), StudyPress{What::choose, value});
}

std::string StudyPanel::typed_text() const {
    if (!chosen_ && !negative_)
        return say(Phrase::study_no_reply_yet);
    const std::string digits = chosen_ ? std::to_string(std::abs(*chosen_)) : "";
    return say(Phrase::study_reply_is, (negative_ ? "-" : "") + digits);
}

void StudyPanel::add_keys(window::Panel& rows, RoomPanel& panel) const {
    rows.rows.push_back({typed_text(), "", {}});
    for (const auto& [first, last] : {std::pair{1, 5}, std::pair{6, 10}}) {
        window::PanelRow keys;
        for (int key = first; key <= last; ++key)
            keys.buttons.push_back(
                panel.button(std::to_string(key % 10), StudyPress{What::digit, key % 10}));
        rows.rows.push_back(std::move(keys));
    }
    window::PanelRow last;
    if (bounds().first < 0)
        last.buttons.push_back(panel.button("-", StudyPress{What::minus}));
    last.buttons.push_back(panel.button(say(Phrase::study_erase), StudyPress{What::erase}));
    rows.rows.push_back(std::move(last));
}

void StudyPanel::add_answers(window::Panel& rows, RoomPanel& panel) const {
    if (step_->kind == StudyKind::consent || step_->kind == StudyKind::yes_no) {
        rows.rows.push_back(
            {"",
             "",
             {answer(say(Phrase::study_yes), 1, panel), answer(say(Phrase::study_no), 0, panel)}});
    } else if (step_->kind == StudyKind::choice) {
        for (std::size_t i = 0; i < step_->choices.size(); ++i)
            rows.rows.push_back(
                {step_->choices[i].text, "", {answer(std::to_string(i + 1), int(i) + 1, panel)}});
    } else if (step_->kind == StudyKind::rating || step_->kind == StudyKind::number) {
        for (const auto& [point, meaning] :
             {std::pair{step_->lowest, step_->left}, std::pair{step_->highest, step_->right}})
            if (!meaning.empty())
                rows.rows.push_back(
                    {say(Phrase::study_points, std::to_string(point), meaning), "", {}});
        if (is_typed())
            return add_keys(rows, panel);
        // The meanings of the lowest and the highest point stand between the question and its
        // points.
        const std::string question = step_->texts.empty() ? "" : step_->texts.back().text;
        window::PanelRow points;
        points.subject = question;
        for (std::int64_t point = step_->lowest; point <= step_->highest;
             point += step_->step_size) {
            if (points.buttons.size() == std::size_t(points_in_row))
                rows.rows.push_back(std::exchange(points, {"", "", {}, {}, question}));
            points.buttons.push_back(answer(std::to_string(point), int(point), panel));
        }
        rows.rows.push_back(std::move(points));
    }
    // A number that is being typed need not be a point yet.
    if (types_digits() && (negative_ || (types_ && chosen_)))
        rows.rows.push_back({typed_text(), "", {}});
}

// Rows without buttons, because their texts change by themselves.
void StudyPanel::add_time(window::Panel& rows, TimePoint now) const {
    if (step_->kind == StudyKind::watch && !may_go_on(now))
        rows.rows.push_back(
            {say(Phrase::study_watch_for, seconds_text(step_->watch - seen_for(now))), "", {}});
    if (step_->limit > Duration(0))
        rows.rows.push_back(
            {seen_for(now) < step_->limit
                 ? say(Phrase::study_time_left, seconds_text(step_->limit - seen_for(now)))
                 : say(Phrase::study_time_over),
             "",
             {}});
}

void StudyPanel::add_ways_on(window::Panel& rows, RoomPanel& panel, TimePoint now) const {
    const auto button = [&](Phrase label, What what) {
        return panel.button(say(label), StudyPress{what});
    };
    if (asks_end_) {
        rows.rows.push_back({say(Phrase::study_really_end),
                             "",
                             {button(Phrase::study_end_it, What::end),
                              button(Phrase::study_keep_on, What::keep_on)}});
        return;
    }
    window::PanelRow on;
    on.subject = "";
    if (may_go_on(now))
        on.buttons.push_back(button(Phrase::study_go_on, What::go_on));
    if (step_->kind >= StudyKind::number)
        on.buttons.push_back(button(Phrase::study_leave_out, What::leave_out));
    if (!on.buttons.empty())
        rows.rows.push_back(std::move(on));
    rows.rows.push_back(
        {say(Phrase::study_step, std::to_string(step_->step), std::to_string(step_->steps)),
         "",
         {button(Phrase::study_aside, What::aside), button(Phrase::study_end, What::ask_end)},
         {},
         ""});
}

// Never 0. Another one where the keyboard has to find its button anew.
std::uint64_t StudyPanel::keyboard_number() const {
    constexpr std::uint64_t states = 8;
    return states * version_ + 1 + (sent_ ? 1 : aside_ ? 2 : asks_end_ ? 3 : 0);
}

void StudyPanel::add_panel(RoomPanel& panel, TimePoint now) const {
    if (!step_)
        return;
    const auto button = [&](Phrase label, What what) {
        return panel.button(say(label), StudyPress{what});
    };
    window::Panel rows{say(Phrase::study), {}};
    rows.keyboard = keyboard_number();
    rows.large = true;
    if (aside_) {
        rows.rows.push_back(
            {say(Phrase::study_step, std::to_string(step_->step), std::to_string(step_->steps)),
             "",
             {button(Phrase::study_show, What::show)}});
    } else if (step_->kind == StudyKind::interrupted) {
        rows.rows.push_back({say(Phrase::study_interrupted), "", {}});
        rows.rows.push_back({"", "", {button(Phrase::study_aside, What::aside)}});
    } else if (step_->kind == StudyKind::over) {
        add_texts(rows);
        rows.rows.push_back({say(Phrase::study_is_over), "", {button(Phrase::close, What::close)}});
    } else {
        add_texts(rows);
        if (sent_) {
            rows.rows.push_back({say(Phrase::study_is_sent), "", {}});
            rows.rows.push_back({"", "", {button(Phrase::study_aside, What::aside)}});
        } else {
            add_answers(rows, panel);
            add_time(rows, now);
            add_ways_on(rows, panel, now);
        }
    }
    panel.panels.push_back(std::move(rows));
}

}  // namespace theatron::viewer
