// SPDX-License-Identifier: Apache-2.0
#include "viewer/bar_items.h"

#include "session/permissions.h"

namespace theatron::viewer {
namespace {

using session::Right;
using window::ToolIcon;

BarItem microphone_item(const BarFacts& facts) {
    BarItem item{ToolIcon::microphone, Phrase::microphone, Phrase::bar_mute};
    if (facts.muted) {
        item.label = Phrase::bar_muted;
        item.hint = Phrase::bar_muted_hint;
        item.off = item.alarm = true;
        return item;
    }
    switch (facts.microphone.value_or(Microphone::none)) {
        case Microphone::open:
            item.pressed = true;
            break;
        case Microphone::waits:
            item.label = Phrase::bar_push_to_talk;
            item.hint = Phrase::bar_push_to_talk_hint;
            break;
        case Microphone::missing:
            item.label = Phrase::bar_no_microphone;
            item.hint = Phrase::bar_no_microphone_hint;
            item.off = item.alarm = true;
            break;
        case Microphone::none:
        case Microphone::closed:
            item.label = Phrase::bar_muted;
            item.hint = Phrase::bar_speak;
            item.off = item.alarm = true;
            break;
    }
    return item;
}

BarItem webcam_item(const BarFacts& facts) {
    const bool is_on = facts.own_face == OwnFace::opening || facts.own_face == OwnFace::seen;
    BarItem item{ToolIcon::webcam, Phrase::webcam,
                 is_on ? Phrase::bar_hide_face : Phrase::bar_show_face};
    item.pressed = is_on;
    item.off = !is_on;
    return item;
}

}  // namespace

std::vector<BarItem> bar_items(const BarFacts& facts) {
    std::vector<BarItem> items;
    const auto add = [&](ToolIcon id, Phrase label, Phrase hint, bool pressed) {
        items.push_back({id, label, hint, pressed});
    };
    if (facts.joined) {
        if (session::may(facts.role, Right::speak))
            items.push_back(microphone_item(facts));
        if (session::may(facts.role, Right::be_seen) && facts.own_face != OwnFace::none)
            items.push_back(webcam_item(facts));
        if (session::may(facts.role, Right::point) && !facts.is_past)
            add(ToolIcon::point, Phrase::bar_point, Phrase::bar_point_hint, facts.points);
        if (session::may(facts.role, Right::handle) && !facts.is_past)
            add(ToolIcon::draw, Phrase::draw, Phrase::bar_draw_hint, facts.draws);
        add(ToolIcon::patient_case, Phrase::case_, Phrase::bar_case_hint, facts.shows_case);
        add(ToolIcon::people, Phrase::people, Phrase::bar_people_hint, facts.shows_people);
        items.back().badge =
            facts.hands + (session::may(facts.role, Right::manage) ? facts.visitors : 0);
    }
    add(ToolIcon::leave, facts.asks_leave ? Phrase::bar_leave_sure : Phrase::bar_leave,
        facts.joined ? Phrase::bar_leave_hint : Phrase::bar_leave_at_once, false);
    items.back().alarm = facts.asks_leave;
    if (facts.joined) {
        add(ToolIcon::more, Phrase::bar_more, Phrase::bar_more_hint, facts.shows_more);
        items.back().badge = facts.unseen;
    }
    return items;
}

}  // namespace theatron::viewer
