// SPDX-License-Identifier: Apache-2.0
#include "window/entry_form_native.h"

#include <imgui_internal.h>  // whether the keyboard's focus is shown

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <deque>
#include <initializer_list>
#include <utility>

#include "phrases/phrase.h"
#include "render/picture_texture.h"
#include "window/imgui_fonts_native.h"
#include "window/panel_colors_native.h"

namespace theatron::window {
namespace {

ImGuiKey key_of(FormKey key) {
    switch (key) {
        case FormKey::tab:
            return ImGuiKey_Tab;
        case FormKey::left:
            return ImGuiKey_LeftArrow;
        case FormKey::right:
            return ImGuiKey_RightArrow;
        case FormKey::up:
            return ImGuiKey_UpArrow;
        case FormKey::down:
            return ImGuiKey_DownArrow;
        case FormKey::home:
            return ImGuiKey_Home;
        case FormKey::end:
            return ImGuiKey_End;
        case FormKey::backspace:
            return ImGuiKey_Backspace;
        case FormKey::erase:
            return ImGuiKey_Delete;
        case FormKey::enter:
            return ImGuiKey_Enter;
        case FormKey::space:
            return ImGuiKey_Space;
        case FormKey::escape:
            return ImGuiKey_Escape;
        case FormKey::a:
            return ImGuiKey_A;
        case FormKey::c:
            return ImGuiKey_C;
        case FormKey::v:
            return ImGuiKey_V;
        case FormKey::x:
            return ImGuiKey_X;
        case FormKey::z:
            return ImGuiKey_Z;
        case FormKey::letters:
            break;
    }
    return ImGuiKey_Space;
}

// Numbers of the places where Tab stops, in its order; a session that was entered before has two.
constexpr int link_stop = 0, name_stop = 1, box_stop = 2, enter_stop = 6, leave_stop = 7,
              paste_stop = 8, recent_stop = 9;
// ImGui carries out a move of the keyboard within three pictures; letters wait for that.
constexpr int settled_after = 3;

// A text that ImGui edits in place.
template <std::size_t size>
struct TextField {
    std::array<char, size> letters{};
    void set(const std::string& text) { std::strncpy(letters.data(), text.c_str(), size - 1); }
    std::string text() const { return letters.data(); }
};

}  // namespace

struct EntryForm::Parts {
    ImGuiContext* context = nullptr;
    ImGuiPass pass;
    Clipboard clipboard;
    std::string pasted;  // what ImGui was given last
    double text_pixels = 0;
    ImFont* normal = nullptr;
    ImFont* small = nullptr;
    ImFont* large = nullptr;

    EntryFields fields;
    TextField<4096> link;
    TextField<64> name;
    std::string hidden_link;  // is shown without its letters while the field holds it
    std::vector<EntryRecent> recents;
    std::optional<RecentAnswer> recent;
    struct Asked {
        std::size_t index = 0;
        bool by_mouse = false;
        TimePoint at;
    };
    std::optional<Asked> asked_forget;  // pressed once
    TimePoint now;
    render::PictureTexture picture;
    std::deque<FormKeyPress> keys;  // one for each picture, as ImGui sees levels
    std::optional<int> held;        // the key that is down in ImGui
    int settling = 0;               // pictures until ImGui has carried out a key that moves
    bool wants_enter = false;       // once the host has answered
    // The places where Tab stops, by their numbers: of this picture, the one that has the keyboard,
    // and the one that gets it.
    std::vector<int> stops;
    std::optional<int> focused_stop, wanted_stop;
    int tab_step = 0;
    bool was_down = false, has_focus = false;
    int fresh = 0;  // pictures since the form appeared; ImGui lays itself out in the first two

    Parts(EntryFields begin, Clipboard the_clipboard)
        : context(ImGui::CreateContext()),
          clipboard(std::move(the_clipboard)),
          fields(std::move(begin)) {
        link.set(fields.link);
        name.set(fields.name);
        ImGuiIO& io = ImGui::GetIO();
        io.IniFilename = nullptr;
        io.ConfigFlags |= ImGuiConfigFlags_NavEnableKeyboard;
        for (int key = 0; key < ImGuiKey_COUNT; ++key)
            io.KeyMap[key] = key;
        io.ClipboardUserData = this;
        io.GetClipboardTextFn = [](void* self) {
            auto& parts = *static_cast<Parts*>(self);
            parts.pasted = parts.clipboard.text();
            return parts.pasted.c_str();
        };
        io.SetClipboardTextFn = [](void* self, const char* text) {
            static_cast<Parts*>(self)->clipboard.set_text(text);
        };
    }
    ~Parts() { ImGui::DestroyContext(context); }

    void make_fonts(double pixels);
    void take(const FormInput& input, Size window);
    EntryAnswer lay_out(const EntryFacts& facts);
    EntryAnswer form(const EntryFacts& facts, float width);
    void recent_list(float width);
    void session(const EntryFacts& facts, float width);
    void label(Phrase words) const;
    void choose(std::size_t recent_index);
    void tab_stop(int number);
    void move_focus();
    bool is_on_button() const;
};

void EntryForm::Parts::make_fonts(double pixels) {
    // The first one is the font of all texts for which no other one is chosen.
    const auto fonts = set_fonts(pass, {pixels, pixels * 0.8, pixels * 1.9});
    normal = fonts[0], small = fonts[1], large = fonts[2];
    text_pixels = pixels;

    const float unit = float(pixels / 2);
    ImGuiStyle& style = ImGui::GetStyle();
    style = ImGuiStyle();
    style.WindowPadding = style.FramePadding = {unit, 0.7f * unit};
    style.WindowPadding = {3 * unit, 2.5f * unit};
    style.ItemSpacing = {unit, 0.8f * unit};
    style.WindowRounding = style.ChildRounding = unit;
    style.FrameRounding = 0.5f * unit;
    style.WindowBorderSize = style.ChildBorderSize = 0;
    const auto set = [&](std::initializer_list<ImGuiCol> parts, ImU32 color) {
        for (const ImGuiCol part : parts)
            style.Colors[part] = ImGui::ColorConvertU32ToFloat4(color);
    };
    set({ImGuiCol_WindowBg}, colors::card);
    set({ImGuiCol_Text}, colors::text);
    set({ImGuiCol_TextDisabled}, colors::label);
    set({ImGuiCol_FrameBg, ImGuiCol_FrameBgActive}, colors::field);
    set({ImGuiCol_Button, ImGuiCol_FrameBgHovered}, colors::button);
    set({ImGuiCol_ButtonHovered, ImGuiCol_ButtonActive}, colors::button_hovered);
    set({ImGuiCol_CheckMark, ImGuiCol_NavHighlight}, colors::key);
}

void EntryForm::Parts::take(const FormInput& input, Size window) {
    ImGuiIO& io = ImGui::GetIO();
    io.DisplaySize = {float(window.width), float(window.height)};
    io.DeltaTime = 1.0f / 60;
    io.MousePos = input.pointer ? ImVec2(float(input.pointer->x) * io.DisplaySize.x,
                                         float(input.pointer->y) * io.DisplaySize.y)
                                : ImVec2(-FLT_MAX, -FLT_MAX);
    io.MouseDown[0] = was_down = input.is_down || input.clicked;
    io.MouseWheel = float(input.wheel);

    keys.insert(keys.end(), input.keys.begin(), input.keys.end());
    io.KeyCtrl = io.KeyShift = false;
    if (held) {
        io.KeysDown[*std::exchange(held, std::nullopt)] = false;
    } else if (settling > 0 || fresh < settled_after) {
        settling = std::max(settling - 1, 0);
    } else if (!keys.empty()) {
        const FormKeyPress press = keys.front();
        keys.pop_front();
        if (press.key == FormKey::letters) {
            io.AddInputCharactersUTF8(press.text.c_str());
            while (!keys.empty() && keys.front().key == FormKey::letters) {
                io.AddInputCharactersUTF8(keys.front().text.c_str());
                keys.pop_front();
            }
        } else if (press.key == FormKey::tab) {
            tab_step = press.shift ? -1 : 1;
        } else {
            held = key_of(press.key);
            io.KeysDown[*held] = true;
            io.KeyCtrl = press.control;
            io.KeyShift = press.shift;
            wants_enter = wants_enter || (press.key == FormKey::enter && !is_on_button());
            if (press.key == FormKey::up || press.key == FormKey::down)
                settling = settled_after;
        }
    }
    // The arrows of the keyboard move between fields, Space presses a button.
    const auto is_down = [&](ImGuiKey key) { return io.KeysDown[key] ? 1.0f : 0.0f; };
    io.NavInputs[ImGuiNavInput_Activate] =
        is_on_button() ? std::max(is_down(ImGuiKey_Space), is_down(ImGuiKey_Enter))
                       : is_down(ImGuiKey_Space);
    io.NavInputs[ImGuiNavInput_KeyUp_] = is_down(ImGuiKey_UpArrow);
    io.NavInputs[ImGuiNavInput_KeyDown_] = is_down(ImGuiKey_DownArrow);
    io.NavInputs[ImGuiNavInput_KeyLeft_] = is_down(ImGuiKey_LeftArrow);
    io.NavInputs[ImGuiNavInput_KeyRight_] = is_down(ImGuiKey_RightArrow);
}

void EntryForm::Parts::label(Phrase words) const {
    ImGui::PushFont(small);
    ImGui::TextDisabled("%s", say(words).c_str());
    ImGui::PopFont();
}

// The item that was laid out last is one.
void EntryForm::Parts::tab_stop(int number) {
    stops.push_back(number);
    if (ImGui::IsItemFocused() || ImGui::IsItemActive())
        focused_stop = number;
    if (wanted_stop == number) {
        ImGui::SetKeyboardFocusHere(-1);
        ImGui::GetCurrentContext()->NavDisableHighlight = false;
        wanted_stop.reset();
        settling = settled_after;
    }
}

void EntryForm::Parts::move_focus() {
    const int step = std::exchange(tab_step, 0);
    if (step == 0 || stops.empty())
        return;
    std::sort(stops.begin(), stops.end());
    const int count = int(stops.size());
    const auto at =
        focused_stop ? std::find(stops.begin(), stops.end(), *focused_stop) : stops.end();
    const int next = at == stops.end() ? (step > 0 ? 0 : count - 1)
                                       : (int(at - stops.begin()) + step + count) % count;
    wanted_stop = stops[std::size_t(next)];
    settling = settled_after;
}

// The keyboard has moved there: Enter presses it.
bool EntryForm::Parts::is_on_button() const {
    const bool is_button = focused_stop && *focused_stop >= enter_stop;
    return is_button && !ImGui::GetCurrentContext()->NavDisableHighlight;
}

EntryAnswer EntryForm::Parts::form(const EntryFacts& facts, float width) {
    EntryAnswer answer = EntryAnswer::none;
    const std::string paste_text = say(Phrase::form_paste);
    const float paste =
        ImGui::CalcTextSize(paste_text.c_str()).x + 2 * ImGui::GetStyle().FramePadding.x;
    label(Phrase::form_link);
    ImGui::SetNextItemWidth(width - paste - ImGui::GetStyle().ItemSpacing.x);
    if (fresh == 0 && fields.link.empty())
        ImGui::SetKeyboardFocusHere();
    const bool is_hidden = !hidden_link.empty() && link.text() == hidden_link;
    ImGui::InputText(
        "##link", link.letters.data(), link.letters.size(),
        ImGuiInputTextFlags_EnterReturnsTrue | (is_hidden ? ImGuiInputTextFlags_Password : 0));
    tab_stop(link_stop);
    ImGui::SameLine();
    if (ImGui::Button(paste_text.c_str()))
        link.set(clipboard.text());
    tab_stop(paste_stop);
    recent_list(width);
    label(Phrase::form_name);
    ImGui::SetNextItemWidth(width);
    if (fresh == 0 && !fields.link.empty())
        ImGui::SetKeyboardFocusHere();
    ImGui::InputText("##name", name.letters.data(), name.letters.size(),
                     ImGuiInputTextFlags_EnterReturnsTrue);
    tab_stop(name_stop);
    ImGui::Checkbox(say(Phrase::form_hears).c_str(), &fields.hears);
    tab_stop(box_stop);
    ImGui::SameLine(0, 2 * float(text_pixels));
    ImGui::Checkbox(say(Phrase::form_speaks).c_str(), &fields.speaks);
    tab_stop(box_stop + 1);
    ImGui::BeginDisabled(!fields.speaks);
    ImGui::Checkbox(say(Phrase::form_may_record).c_str(), &fields.voice_may_record);
    if (fields.speaks)
        tab_stop(box_stop + 2);
    ImGui::EndDisabled();
    ImGui::Checkbox(say(Phrase::form_shows_face).c_str(), &fields.shows_face);
    tab_stop(box_stop + 3);

    ImGui::Dummy({0, 0.5f * float(text_pixels)});
    if (facts.is_problem)
        ImGui::PushStyleColor(ImGuiCol_Text, colors::warning);
    ImGui::PushTextWrapPos(ImGui::GetCursorPosX() + width);
    ImGui::TextUnformatted(facts.hint.c_str());
    ImGui::PopTextWrapPos();
    if (facts.is_problem)
        ImGui::PopStyleColor();
    ImGui::Dummy({0, 0.3f * float(text_pixels)});

    const bool ready = facts.can_enter && !name.text().empty();
    ImGui::BeginDisabled(!ready);
    ImGui::PushStyleColor(ImGuiCol_Button, colors::main_button);
    ImGui::PushStyleColor(ImGuiCol_ButtonHovered, colors::main_button_hovered);
    ImGui::PushStyleColor(ImGuiCol_ButtonActive, colors::main_button_hovered);
    if (ImGui::Button(say(Phrase::form_enter).c_str(),
                      {11 * float(text_pixels), 2.2f * float(text_pixels)}))
        answer = EntryAnswer::enter;
    if (ready)
        tab_stop(enter_stop);
    ImGui::PopStyleColor(3);
    ImGui::EndDisabled();
    ImGui::SameLine();
    if (ImGui::Button(say(Phrase::close).c_str(),
                      {5 * float(text_pixels), 2.2f * float(text_pixels)}))
        answer = EntryAnswer::leave;
    tab_stop(leave_stop);
    // Enter waits for the host's answer about this link, and for nothing else.
    const std::string typed = link.text();
    if (typed != fields.link || typed.empty() || name.text().empty() || facts.is_problem)
        wants_enter = false;
    if (std::exchange(wants_enter, wants_enter && !ready) && ready)
        answer = EntryAnswer::enter;
    fields.link = typed;
    fields.name = name.text();
    return answer;
}

// After a click the keyboard goes on with the name, where Enter enters.
void EntryForm::Parts::choose(std::size_t recent_index) {
    recent = RecentAnswer{recent_index, false};
    if (ImGui::IsMouseReleased(ImGuiMouseButton_Left))
        wanted_stop = name_stop;
}

// One line for each: the button that chooses it, and the one that forgets it.
void EntryForm::Parts::recent_list(float width) {
    if (recents.empty())
        return;
    label(Phrase::form_recent);
    ImGui::PushFont(small);
    const std::string forget_text = say(Phrase::form_forget);
    const float forget =
        ImGui::CalcTextSize(forget_text.c_str()).x + 2 * ImGui::GetStyle().FramePadding.x;
    ImGui::PushStyleVar(ImGuiStyleVar_ButtonTextAlign, {0, 0.5f});
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding,
                        {ImGui::GetStyle().FramePadding.x, 0.2f * float(text_pixels)});
    for (std::size_t i = 0; i < recents.size(); ++i) {
        ImGui::PushID(int(i));
        const std::string line = recents[i].session + "   " + recents[i].place;
        if (ImGui::Button(line.c_str(), {width - forget - ImGui::GetStyle().ItemSpacing.x, 0}))
            choose(i);
        tab_stop(recent_stop + 2 * int(i));
        ImGui::SameLine();
        const bool is_asked = asked_forget && asked_forget->index == i;
        // One id, so that the second press is one on the same button.
        const bool pressed = ImGui::Button(
            ((is_asked ? say(Phrase::form_sure) : forget_text) + "###forget").c_str(), {forget, 0});
        if (pressed && is_asked)
            recent = RecentAnswer{i, true};
        tab_stop(recent_stop + 2 * int(i) + 1);
        const bool is_there =
            is_asked && (asked_forget->by_mouse ? ImGui::IsItemHovered() : ImGui::IsItemFocused());
        if (pressed && !is_asked)
            asked_forget = Asked{i, ImGui::IsItemHovered(), now};
        else if (is_asked && (pressed || !is_there || now - asked_forget->at > sure_within))
            asked_forget.reset();
        ImGui::PopID();
    }
    ImGui::PopStyleVar(2);
    ImGui::PopFont();
}

void EntryForm::Parts::session(const EntryFacts& facts, float width) {
    if (facts.title.empty())
        return;
    if (const Size size = picture.size(); size.width > 0) {
        const float scale = width / float(size.width);
        ImGui::Image(texture_of(picture.texture()), {width, scale * float(size.height)});
    }
    ImGui::PushTextWrapPos(ImGui::GetCursorPosX() + width);
    ImGui::TextUnformatted(facts.title.c_str());
    for (const std::string& line : facts.lines) {
        ImGui::PushFont(small);
        ImGui::PushStyleColor(ImGuiCol_Text, colors::label);
        ImGui::TextUnformatted(line.c_str());
        ImGui::PopStyleColor();
        ImGui::PopFont();
    }
    ImGui::PopTextWrapPos();
}

EntryAnswer EntryForm::Parts::lay_out(const EntryFacts& facts) {
    const ImVec2 window = ImGui::GetIO().DisplaySize;
    const float em = float(text_pixels);
    const ImVec2 padding = ImGui::GetStyle().WindowPadding;
    // The session stands beside the form where there is room for it, else below.
    const bool beside = window.x >= 44 * em && !facts.title.empty();
    const float form_width = std::min(28 * em, window.x - 2 * padding.x - em);
    const float session_width = 13 * em, gap = 3 * em;
    ImGui::SetNextWindowSize({form_width + 2 * padding.x + (beside ? gap + session_width : 0), 0});
    ImGui::SetNextWindowPos({window.x / 2, window.y / 2}, ImGuiCond_Always, {0.5f, 0.5f});
    ImGui::SetNextWindowSizeConstraints({0, 0}, {window.x, window.y});
    ImGui::Begin("entry", nullptr,
                 ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                     ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoSavedSettings);
    ImGui::BeginGroup();
    ImGui::PushFont(large);
    ImGui::TextUnformatted("Theatron");
    ImGui::PopFont();
    ImGui::TextDisabled("%s", say(Phrase::form_subtitle).c_str());
    ImGui::Dummy({0, 0.5f * em});
    stops.clear();
    focused_stop.reset();
    const EntryAnswer answer = form(facts, form_width);
    move_focus();
    ImGui::EndGroup();
    if (beside)
        ImGui::SameLine(0, gap);
    ImGui::BeginGroup();
    session(facts, beside ? session_width : form_width);
    ImGui::EndGroup();
    ImGui::End();
    return answer;
}

EntryForm::EntryForm(EntryFields fields, Clipboard clipboard)
    : parts_(std::make_unique<Parts>(std::move(fields), std::move(clipboard))) {}
EntryForm::~EntryForm() = default;

void EntryForm::set_recents(std::vector<EntryRecent> recents) {
    parts_->recents = std::move(recents);
    parts_->asked_forget.reset();
}

void EntryForm::set_hidden_link(const std::string& link) {
    parts_->link.set(link);
    parts_->fields.link = parts_->hidden_link = parts_->link.text();
}

std::optional<RecentAnswer> EntryForm::take_recent() {
    return std::exchange(parts_->recent, std::nullopt);
}

void EntryForm::set_picture(ColorView picture) {
    parts_->picture.set(picture);
}

EntryAnswer EntryForm::draw(const EntryFacts& facts, const FormInput& input, Size window,
                            double text_pixels, TimePoint now, unsigned framebuffer) {
    Parts& p = *parts_;
    p.now = now;
    ImGui::SetCurrentContext(p.context);
    if (p.text_pixels != text_pixels)
        p.make_fonts(text_pixels);
    const bool escape =
        std::any_of(input.keys.begin(), input.keys.end(),
                    [](const FormKeyPress& press) { return press.key == FormKey::escape; });
    p.take(input, window);
    ImGui::NewFrame();
    EntryAnswer answer = p.lay_out(facts);
    p.has_focus = ImGui::GetIO().WantTextInput;
    p.fresh = std::min(p.fresh + 1, settled_after);
    ImGui::Render();
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glViewport(0, 0, window.width, window.height);
    const ImVec4 behind = ImGui::ColorConvertU32ToFloat4(colors::ground);
    glClearBufferfv(GL_COLOR, 0, &behind.x);
    p.pass.draw(*ImGui::GetDrawData(), render::DrawTarget{framebuffer, 0, 0, window});
    if (escape)
        answer = EntryAnswer::leave;
    return answer;
}

bool EntryForm::is_animated() const {
    const Parts& p = *parts_;
    return p.fresh < settled_after || !p.keys.empty() || p.held || p.settling > 0 ||
           p.wanted_stop || p.tab_step != 0 || p.wants_enter || p.was_down || p.has_focus ||
           p.asked_forget;
}

const EntryFields& EntryForm::fields() const {
    return parts_->fields;
}

}  // namespace theatron::window
