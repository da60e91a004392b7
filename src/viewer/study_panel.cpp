// SPDX-License-Identifier: Apache-2.0
#include "viewer/study_panel.h"

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
    sent_.reset();
    if (step_->kind == StudyKind::interrupted)
        return false;
    const std::pair now_shown{step_->step, step_->kind};
    const bool is_same = std::exchange(last_, now_shown) == now_shown;
    if (is_same && step_->problem.empty())  // told again: what the person has chosen stays
        return false;
    chosen_.reset();
    aside_ = asks_end_ = false;
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

bool StudyPanel::may_go_on(TimePoint now) const {
    if (is_question())
        return chosen_ && *chosen_ >= bounds().first && *chosen_ <= bounds().second;
    return step_->kind != StudyKind::watch || seen_for(now) >= step_->watch;
}

std::optional<wire::StudyReply> StudyPanel::carry_out(const StudyPress& press, TimePoint now) {
    if (!step_)
        return std::nullopt;
    using wire::StudyAction;
    const auto send = [&](StudyAction action, int value = 0) {
        sent_ = now;
        asks_end_ = false;
        return wire::StudyReply{step_->step, action, value};
    };
    constexpr int most_digits_value = 99'999;
    switch (press.what) {
        case What::choose:
            chosen_ = press.value;
            break;
        case What::digit:
            if (chosen_.value_or(0) <= most_digits_value)
                chosen_ = chosen_.value_or(0) * 10 + press.value;
            break;
        case What::erase:
            chosen_ = chosen_ && *chosen_ >= 10 ? std::optional(*chosen_ / 10) : std::nullopt;
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

void StudyPanel::add_texts(xr::Panel& rows) const {
    for (const wire::StudyText& text : step_->texts)
        rows.rows.push_back({text.text, "", {}});
    if (!step_->problem.empty())
        rows.rows.push_back({step_->problem, "", {}});
}

xr::PanelButton StudyPanel::answer(const std::string& label, int value, RoomPanel& panel) const {
    return panel.button(marked(label, chosen_ == value), StudyPress{What::choose, value});
}

void StudyPanel::add_keys(xr::Panel& rows, RoomPanel& panel) const {
    rows.rows.push_back({chosen_ ? say(Phrase::study_reply_is, std::to_string(*chosen_))
                                 : say(Phrase::study_no_reply_yet),
                         "",
                         {}});
    for (const auto& [first, last] : {std::pair{1, 5}, std::pair{6, 10}}) {
        xr::PanelRow keys;
        for (int key = first; key <= last; ++key)
            keys.buttons.push_back(
                panel.button(std::to_string(key % 10), StudyPress{What::digit, key % 10}));
        rows.rows.push_back(std::move(keys));
    }
    rows.rows.push_back(
        {"", "", {panel.button(say(Phrase::study_erase), StudyPress{What::erase})}});
}

void StudyPanel::add_answers(xr::Panel& rows, RoomPanel& panel) const {
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
        xr::PanelRow points;
        for (std::int64_t point = step_->lowest; point <= step_->highest;
             point += step_->step_size) {
            if (points.buttons.size() == std::size_t(points_in_row))
                rows.rows.push_back(std::exchange(points, {}));
            points.buttons.push_back(answer(std::to_string(point), int(point), panel));
        }
        rows.rows.push_back(std::move(points));
    }
}

// Rows without buttons, because their texts change by themselves.
void StudyPanel::add_time(xr::Panel& rows, TimePoint now) const {
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

void StudyPanel::add_ways_on(xr::Panel& rows, RoomPanel& panel, TimePoint now) const {
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
    xr::PanelRow on;
    if (may_go_on(now))
        on.buttons.push_back(button(Phrase::study_go_on, What::go_on));
    if (step_->kind >= StudyKind::number)
        on.buttons.push_back(button(Phrase::study_leave_out, What::leave_out));
    if (!on.buttons.empty())
        rows.rows.push_back(std::move(on));
    rows.rows.push_back(
        {say(Phrase::study_step, std::to_string(step_->step), std::to_string(step_->steps)),
         "",
         {button(Phrase::study_aside, What::aside), button(Phrase::study_end, What::ask_end)}});
}

void StudyPanel::add_panel(RoomPanel& panel, TimePoint now) const {
    if (!step_)
        return;
    const auto button = [&](Phrase label, What what) {
        return panel.button(say(label), StudyPress{what});
    };
    xr::Panel rows{say(Phrase::study), {}};
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
        if (sent_ && now - *sent_ < again_after) {
            rows.rows.push_back({say(Phrase::study_is_kept), "", {}});
        } else {
            add_answers(rows, panel);
            add_time(rows, now);
            add_ways_on(rows, panel, now);
        }
    }
    panel.panels.push_back(std::move(rows));
}

}  // namespace theatron::viewer
