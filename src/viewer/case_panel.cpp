// SPDX-License-Identifier: Apache-2.0
#include "viewer/case_panel.h"

#include <algorithm>
#include <cmath>

#include "phrases/phrase.h"
#include "viewer/case_actions.h"
#include "viewer/tools/slice.h"

namespace theatron::viewer {
namespace {

using client::Participant;

constexpr double opacity_step = 0.2, apart = 0.6;

std::string megabytes(std::uint64_t bytes) {
    return std::to_string((bytes + 500'000) / 1'000'000) + " MB";
}

std::string state_of(const CasePanelFacts& facts) {
    const client::OpenCase* content = facts.content;
    if (!content)
        return "";
    if (!content->problem.empty())
        return content->problem;
    return content->is_complete() ? ""
                                  : say(Phrase::amount_of, megabytes(content->progress.got),
                                        megabytes(content->progress.all));
}

void add_text(std::string& all, Phrase what, const std::string& text) {
    if (!text.empty())
        all += (all.empty() ? "" : ", ") + say(what, text);
}

bool is_known(const wire::Patient& patient) {
    return !patient.name.empty() || !patient.birth_date.empty() || !patient.id.empty();
}

// The panel is over the picture of this person alone, and in no saved picture.
window::PanelRow patient_row(const wire::Patient& patient) {
    std::string detail;
    add_text(detail, Phrase::born, patient.birth_date);
    add_text(detail, Phrase::patient_number, patient.id);
    add_text(detail, Phrase::images_of, patient.study_date);
    return {patient.name.empty() ? say(Phrase::patient) : say(Phrase::patient_named, patient.name),
            detail,
            {}};
}

// "Open the case of Doe, Jane, born 1961-02-03, images of 2026-03-01?"
std::string question_of(const AskedCase& asked, const std::string& name) {
    const wire::Patient& patient = asked.patient;
    if (!is_known(patient))
        return say(Phrase::open_case_named, name);
    std::string who = patient.name;
    if (who.empty())
        add_text(who, Phrase::patient_number, patient.id);
    add_text(who, Phrase::born, patient.birth_date);
    add_text(who, Phrase::images_of, patient.study_date);
    return say(Phrase::open_case_of, who);
}

std::string detail_of(const AskedCase& asked, const std::string& name) {
    if (!asked.is_answered)
        return say(Phrase::patient_is_asked);
    if (!is_known(asked.patient))
        return say(Phrase::patient_not_known);
    std::string detail = name;
    if (!asked.patient.name.empty())
        add_text(detail, Phrase::patient_number, asked.patient.id);
    return detail;
}

// The name of a window of medical/window.h, in the person's language if it is known here.
std::string window_name(std::string_view name) {
    for (const Phrase known : {Phrase::abdomen, Phrase::liver, Phrase::vessels, Phrase::lung,
                               Phrase::bone, Phrase::brain})
        if (name == sentence_of(known).in(Language::english))
            return say(known);
    return std::string(name);
}

class Builder {
public:
    Builder(RoomPanel& panel) : panel_(panel) {}

    window::PanelButton button(std::string label, RoomCommand command) {
        return panel_.button(std::move(label), std::move(command));
    }
    window::PanelButton action(std::string label, std::function<bool(Participant&)> action) {
        return button(std::move(label), ChangeCase{std::move(action)});
    }
    window::PanelButton action(Phrase label, std::function<bool(Participant&)> action) {
        return this->action(say(label), std::move(action));
    }
    void row(window::PanelRow row) { rows_.push_back(std::move(row)); }
    void row(std::string text, std::string detail, std::vector<window::PanelButton> buttons) {
        row({std::move(text), std::move(detail), std::move(buttons)});
    }
    void finish(std::string title) { panel_.panels.push_back({std::move(title), rows_}); }

private:
    RoomPanel& panel_;
    std::vector<window::PanelRow> rows_;
};

void add_parts(const CasePanelFacts& facts, Builder& add) {
    if (!facts.content || !facts.content->description)
        return;
    const auto& parts = facts.content->description->parts;
    for (std::size_t i = 0; i < facts.room->parts.size(); ++i) {
        const session::CasePart part = facts.room->parts[i].facts;
        if (part.part >= parts.size())
            continue;
        const double opacity = part.opacity / 255.0;
        const auto change = [&](double by) {
            return [number = part.part, to = std::clamp(opacity + by, 0.0, 1.0)](Participant& p) {
                return set_opacity(p, number, to);
            };
        };
        add.row(
            parts[part.part].name,
            say(part.shown ? Phrase::opacity : Phrase::opacity_hidden,
                std::to_string(std::lround(opacity * 100))),
            {add.action(part.shown ? Phrase::hide : Phrase::show,
                        [part](Participant& p) { return show_part(p, part.part, !part.shown); }),
             add.action("-", change(-opacity_step)), add.action("+", change(opacity_step))});
    }
}

void add_series(const CasePanelFacts& facts, Builder& add) {
    const auto& series = facts.content->description->series;
    std::vector<window::PanelButton> buttons;
    for (std::size_t i = 0; i < series.size(); ++i) {
        const session::CaseScreen next =
            of_series(facts.room->screen->facts, int(i), facts.content->volumes[i].get());
        buttons.push_back(
            add.action(series[i].name, [next](Participant& p) { return set_screen(p, next); }));
    }
    if (buttons.size() > 1)
        add.row(say(Phrase::series), "", std::move(buttons));
}

void add_pictures(const CasePanelFacts& facts, Builder& add) {
    const auto& pictures = facts.content->description->pictures;
    if (pictures.empty())
        return;
    const session::CaseScreen screen = facts.room->screen->facts;
    const auto step = [&](Phrase label, int steps) {
        return add.action(label, [next = stepped(screen, int(pictures.size()), steps)](
                                     Participant& p) { return set_screen(p, next); });
    };
    if (!screen.picture || *screen.picture >= pictures.size())
        return add.row(say(Phrase::pictures), std::to_string(pictures.size()),
                       {step(Phrase::show, 0)});
    add.row(say(Phrase::pictures),
            say(Phrase::amount_of, std::to_string(*screen.picture + 1),
                std::to_string(pictures.size())),
            {step(Phrase::before, -1), step(Phrase::next, 1)});
}

void add_screen(const CasePanelFacts& facts, Builder& add) {
    if (!facts.room->screen || !facts.content || !facts.content->description)
        return;
    add_series(facts, add);
    add_pictures(facts, add);
    add.row(say(Phrase::screen),
            facts.presents             ? say(Phrase::you_present)
            : !facts.presenter.empty() ? say(Phrase::presents, facts.presenter)
                                       : say(Phrase::all_may_change),
            {add.action(facts.presents ? Phrase::all_may : Phrase::present,
                        [on = !facts.presents](Participant& p) { return present(p, on); })});
    if (!facts.volume)
        return;
    const session::CaseScreen screen = facts.room->screen->facts;
    std::vector<window::PanelButton> planes, windows;
    const Phrase names[] = {Phrase::axial, Phrase::coronal, Phrase::sagittal};
    for (int i = 0; i < 3; ++i)
        planes.push_back(
            add.action(names[i], [next = turned(screen, *facts.volume, medical::Orientation(i))](
                                     Participant& p) { return set_screen(p, next); }));
    for (const medical::WindowPreset& preset : medical::window_presets()) {
        session::CaseScreen next = screen;
        next.center = preset.window.center;
        next.width = preset.window.width;
        windows.push_back(add.action(window_name(preset.name),
                                     [next](Participant& p) { return set_screen(p, next); }));
    }
    add.row(say(Phrase::images), "", std::move(planes));
    const auto half = windows.begin() + std::ptrdiff_t(windows.size() / 2);
    add.row(say(Phrase::window), "", {windows.begin(), half});
    add.row("", "", {half, windows.end()});
}

// "Cancel" is where "Open" was: a double click opens nothing.
void add_question(const AskedCase& asked, const std::string& name, Builder& add) {
    std::vector<window::PanelButton> buttons;
    if (asked.is_answered)
        buttons.push_back(add.button(say(Phrase::open), OpenOffered{asked.offered}));
    buttons.push_back(add.button(say(Phrase::cancel), LeaveClosed{}));
    add.row(question_of(asked, name), detail_of(asked, name), std::move(buttons));
}

}  // namespace

void add_case_panel(const CasePanelFacts& facts, RoomPanel& panel) {
    Builder add(panel);
    if (facts.room) {
        const bool known = facts.content && facts.content->description;
        add.row(known                      ? facts.content->description->name
                : facts.room->name.empty() ? say(Phrase::a_case)
                                           : facts.room->name,
                state_of(facts),
                {add.action(Phrase::life_size, [](Participant& p) { return set_scale(p, 1); }),
                 add.action(Phrase::close, close_case)});
        if (is_known(facts.patient))
            add.row(patient_row(facts.patient));
        const bool is_apart = facts.room->organ.explosion != 0, cut = facts.room->organ.cut;
        std::vector<window::PanelButton> buttons{
            add.action(is_apart ? Phrase::closer : Phrase::apart,
                       [is_apart](Participant& p) { return explode(p, is_apart ? 0 : apart); }),
            add.action(Phrase::together, put_together)};
        if (facts.volume)
            buttons.push_back(add.action(cut ? Phrase::whole : Phrase::cut,
                                         [cut](Participant& p) { return cut_at_slice(p, !cut); }));
        add.row(say(Phrase::parts), cut ? say(Phrase::is_cut) : "", std::move(buttons));
        add_screen(facts, add);
        add_parts(facts, add);
    }
    for (const wire::OfferedCase& offered : facts.offered) {
        const auto hash = to_content_hash(offered.hash);
        if (!hash || (facts.room && facts.room->organ.of_case == *hash))
            continue;
        if (facts.asked && facts.asked->offered == *hash)
            add_question(*facts.asked, offered.name, add);
        else
            add.row(offered.name, megabytes(offered.bytes),
                    {add.button(say(Phrase::open), AskToOpen{*hash})});
    }
    if (!facts.room && facts.offered.empty())
        add.row(say(Phrase::no_case), "", {});
    add.finish(say(Phrase::case_));
}

}  // namespace theatron::viewer
