// SPDX-License-Identifier: Apache-2.0
#include "window/desktop_window_native.h"

#define SDL_MAIN_HANDLED
#include <SDL.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <optional>

#include "base/error.h"
#include "render/gl_errors_native.h"
#include "window/input_queue.h"
#include "window/x11_window_native.h"

namespace theatron::window {
namespace {

[[noreturn]] void fail(const std::string& what) {
    throw Error(what + " (" + SDL_GetError() + ").");
}

// SDL's video, for as long as the window. Its events stay until the program's end, since sounds
// add some from threads of their own, and SDL as a whole does for their sake.
struct Library {
    Library() {
        SDL_SetMainReady();
        // Ctrl-C is the program's own business.
        SDL_SetHint(SDL_HINT_NO_SIGNAL_HANDLERS, "1");
        // Through EGL also under X11, as everything else that draws here.
        SDL_SetHint(SDL_HINT_VIDEO_X11_FORCE_EGL, "1");
        // The window manager stays in charge, and may compose other windows over ours.
        SDL_SetHint(SDL_HINT_VIDEO_X11_NET_WM_BYPASS_COMPOSITOR, "0");
        // Only desktops: a bare graphics card, which SDL would also draw on, may belong to a
        // screen elsewhere. Without that folder Wayland's library prints warnings.
        const bool wayland = std::getenv("XDG_RUNTIME_DIR") || std::getenv("WAYLAND_DISPLAY");
        SDL_SetHint(SDL_HINT_VIDEODRIVER, wayland ? "x11,wayland" : "x11");
        [[maybe_unused]] static const int events = SDL_InitSubSystem(SDL_INIT_EVENTS);
        if (SDL_InitSubSystem(SDL_INIT_VIDEO) != 0)
            throw Error("There is no display to open a window on.");
        const std::string driver = SDL_GetCurrentVideoDriver();
        if (driver == "offscreen" || driver == "dummy") {
            SDL_QuitSubSystem(SDL_INIT_VIDEO);
            throw Error("There is no display to open a window on.");
        }
    }
    ~Library() { SDL_QuitSubSystem(SDL_INIT_VIDEO); }
};

std::optional<KeyPress> pressed(const SDL_Keysym& key) {
    // Alt+Tab and the like belong to the desktop.
    if (key.mod & (KMOD_CTRL | KMOD_ALT | KMOD_GUI))
        return std::nullopt;
    // Digits by their place: some keyboards need Shift for them.
    if (key.scancode >= SDL_SCANCODE_1 && key.scancode <= SDL_SCANCODE_9)
        return KeyPress{Action::view_camera, int(key.scancode) - int(SDL_SCANCODE_1)};
    if (key.scancode >= SDL_SCANCODE_KP_1 && key.scancode <= SDL_SCANCODE_KP_9)
        return KeyPress{Action::view_camera, int(key.scancode) - int(SDL_SCANCODE_KP_1)};
    if (key.scancode == SDL_SCANCODE_0)
        return KeyPress{Action::from_above};
    // On AZERTY keyboards, the place of W has the letter Z and flies; that of Z has the letter W.
    if (key.scancode == SDL_SCANCODE_W && key.sym == SDLK_z)
        return std::nullopt;
    if (key.scancode == SDL_SCANCODE_Z && key.sym == SDLK_w)
        return KeyPress{Action::marks};
    switch (key.sym) {
        case SDLK_ESCAPE:
            return KeyPress{Action::leave};
        case SDLK_F1:
        case SDLK_h:
            return KeyPress{Action::help};
        case SDLK_b:
            return KeyPress{Action::facts};
        case SDLK_KP_0:
            return KeyPress{Action::from_above};
        case SDLK_PLUS:
        case SDLK_EQUALS:
        case SDLK_KP_PLUS:
            return KeyPress{Action::larger_points};
        case SDLK_MINUS:
        case SDLK_KP_MINUS:
            return KeyPress{Action::smaller_points};
        case SDLK_SPACE:
            return KeyPress{Action::freeze};
        case SDLK_F7:
            return KeyPress{Action::push_to_talk};
        case SDLK_F3:
            return KeyPress{Action::chat};
        case SDLK_F12:
            return KeyPress{Action::raise_hand};
        case SDLK_F4:
            return KeyPress{Action::own_face};
        case SDLK_F8:
            return KeyPress{Action::voice_recording};
        case SDLK_F9:
            return KeyPress{Action::save_picture};
        case SDLK_F10:
            return KeyPress{Action::save_points};
        case SDLK_F2:
            return KeyPress{Action::camera_pictures};
        case SDLK_F5:
            return KeyPress{Action::pause_recording};
        case SDLK_COMMA:
            return KeyPress{Action::seek_back};
        case SDLK_PERIOD:
        case SDLK_SEMICOLON:  // beside the comma where the full stop needs Shift
            return KeyPress{Action::seek_forward};
        case SDLK_END:
            return KeyPress{Action::live};
        case SDLK_F6:
            return KeyPress{Action::adjust_cameras};
        case SDLK_LEFT:
            return KeyPress{Action::nudge, 0, Nudge::left};
        case SDLK_RIGHT:
            return KeyPress{Action::nudge, 0, Nudge::right};
        case SDLK_UP:
            return KeyPress{Action::nudge, 0, Nudge::farther};
        case SDLK_DOWN:
            return KeyPress{Action::nudge, 0, Nudge::nearer};
        case SDLK_PAGEUP:
            return KeyPress{Action::nudge, 0, Nudge::up};
        case SDLK_PAGEDOWN:
            return KeyPress{Action::nudge, 0, Nudge::down};
        case SDLK_LEFTBRACKET:
            return KeyPress{Action::nudge, 0, Nudge::turn_left};
        case SDLK_RIGHTBRACKET:
            return KeyPress{Action::nudge, 0, Nudge::turn_right};
        case SDLK_F11:
            return KeyPress{Action::full_screen};
        case SDLK_TAB:
            return KeyPress{(key.mod & KMOD_SHIFT) != 0 ? Action::previous_control
                                                        : Action::next_control};
        case SDLK_RETURN:
        case SDLK_KP_ENTER:
            return KeyPress{Action::press_control};
        case SDLK_m:
            return KeyPress{Action::next_renderer};
        case SDLK_c:
            return KeyPress{Action::next_depth_codec};
        case SDLK_v:
            return KeyPress{Action::next_color_codec};
        case SDLK_n:
            return KeyPress{Action::new_brick};
        case SDLK_g:
            return KeyPress{Action::give};
        case SDLK_y:
            return KeyPress{Action::admit};
        case SDLK_k:
            return KeyPress{Action::call};
        case SDLK_j:
            return KeyPress{Action::come};
        case SDLK_u:
            return KeyPress{Action::turn_away};
        case SDLK_DELETE:
            return KeyPress{Action::remove};
        case SDLK_x:
            return KeyPress{Action::sit_or_stand};
        case SDLK_l:
            return KeyPress{Action::microphone};
        case SDLK_p:
            return KeyPress{Action::people};
        case SDLK_o:
            return KeyPress{Action::show_case};
        case SDLK_i:
            return KeyPress{Action::slice_here};
        case SDLK_z:
            return KeyPress{Action::marks};
        case SDLK_BACKSPACE:
            return KeyPress{Action::undo_mark};
        case SDLK_r:
        case SDLK_HOME:
            return KeyPress{Action::own_view};
        default:
            return std::nullopt;
    }
}

std::optional<FormKey> form_key(const SDL_Keysym& key) {
    switch (key.sym) {
        case SDLK_TAB:
            return FormKey::tab;
        case SDLK_LEFT:
            return FormKey::left;
        case SDLK_RIGHT:
            return FormKey::right;
        case SDLK_UP:
            return FormKey::up;
        case SDLK_DOWN:
            return FormKey::down;
        case SDLK_HOME:
            return FormKey::home;
        case SDLK_END:
            return FormKey::end;
        case SDLK_BACKSPACE:
            return FormKey::backspace;
        case SDLK_DELETE:
            return FormKey::erase;
        case SDLK_RETURN:
        case SDLK_KP_ENTER:
            return FormKey::enter;
        case SDLK_SPACE:
            return FormKey::space;
        case SDLK_ESCAPE:
            return FormKey::escape;
        default:
            break;
    }
    if (!(key.mod & KMOD_CTRL))
        return std::nullopt;
    switch (key.sym) {
        case SDLK_a:
            return FormKey::a;
        case SDLK_c:
            return FormKey::c;
        case SDLK_v:
            return FormKey::v;
        case SDLK_x:
            return FormKey::x;
        case SDLK_z:
            return FormKey::z;
        default:
            return std::nullopt;
    }
}

// The keys that fly, by their place on the keyboard: WASD is a shape, not four letters.
void read_held_keys(Steering& steering) {
    if (SDL_GetModState() & (KMOD_CTRL | KMOD_ALT | KMOD_GUI))
        return;
    const Uint8* held = SDL_GetKeyboardState(nullptr);
    const auto axis = [&](SDL_Scancode more, SDL_Scancode less) {
        return double(held[more]) - double(held[less]);
    };
    steering.fly = {axis(SDL_SCANCODE_D, SDL_SCANCODE_A), axis(SDL_SCANCODE_E, SDL_SCANCODE_Q),
                    axis(SDL_SCANCODE_W, SDL_SCANCODE_S)};
    steering.fast = held[SDL_SCANCODE_LSHIFT] || held[SDL_SCANCODE_RSHIFT];
}

}  // namespace

struct DesktopWindow::Parts {
    Library library;
    SDL_Window* window = nullptr;
    SDL_GLContext context = nullptr;
    Uint32 wake_event = 0;
    std::atomic<bool> woken = false;
    InputQueue inputs;
    bool takes_text = false;
    // A key came after which letters may mean something else: what follows it waits until the owner
    // has taken the key and said so.
    bool awaits_owner = false;
    render::GlErrors errors;

    ~Parts() {
        if (context)
            SDL_GL_DeleteContext(context);
        if (window)
            SDL_DestroyWindow(window);
    }
    // Leaves the window open, without a context, where the driver has none of this kind.
    bool open(const std::string& title, Size size, int profile, int major, int minor);
    double window_height() const {
        int width = 0, height = 0;
        SDL_GetWindowSize(window, &width, &height);
        return std::max(height, 1);
    }
    // A place in the window in shares of its width and height.
    Vec2 shares_of(int x, int y) const {
        int width = 0, height = 0;
        SDL_GetWindowSize(window, &width, &height);
        return {(x + 0.5) / std::max(width, 1), (y + 0.5) / std::max(height, 1)};
    }
    void take(const SDL_Event& event);
};

bool DesktopWindow::Parts::open(const std::string& title, Size size, int profile, int major,
                                int minor) {
    SDL_GL_SetAttribute(SDL_GL_CONTEXT_PROFILE_MASK, profile);
    SDL_GL_SetAttribute(SDL_GL_CONTEXT_MAJOR_VERSION, major);
    SDL_GL_SetAttribute(SDL_GL_CONTEXT_MINOR_VERSION, minor);
    // The attributes take effect when a window is created, so each kind of GL needs a new one.
    if (window)
        SDL_DestroyWindow(window);
    window = SDL_CreateWindow(title.c_str(), SDL_WINDOWPOS_CENTERED, SDL_WINDOWPOS_CENTERED,
                              size.width, size.height,
                              SDL_WINDOW_OPENGL | SDL_WINDOW_RESIZABLE | SDL_WINDOW_ALLOW_HIGHDPI);
    context = window ? SDL_GL_CreateContext(window) : nullptr;
    return context != nullptr;
}

DesktopWindow::DesktopWindow(const std::string& title, Size size, const std::string& instead) try
    : parts_(std::make_unique<Parts>()) {
    // The clouds are drawn elsewhere and copied here.
    SDL_GL_SetAttribute(SDL_GL_DEPTH_SIZE, 0);
    // Some desktop drivers have no OpenGL ES.
    if (!parts_->open(title, size, SDL_GL_CONTEXT_PROFILE_ES, 3, 0) &&
        !parts_->open(title, size, SDL_GL_CONTEXT_PROFILE_CORE, 4, 2))
        fail(parts_->window ? "The graphics driver offers neither OpenGL ES 3 nor OpenGL 4.2"
                            : "No window can be opened here");
    SDL_SetWindowMinimumSize(parts_->window, 320, 240);
    // Where the driver cannot wait for the screen, the owner's own pace must do.
    SDL_GL_SetSwapInterval(1);
    parts_->wake_event = SDL_RegisterEvents(1);
    parts_->errors.watch();
} catch (const Error& problem) {
    throw Error(problem.what() + (instead.empty() ? "" : " " + instead));
}

DesktopWindow::~DesktopWindow() = default;

void DesktopWindow::wait(Duration timeout) {
    const auto ms = std::chrono::ceil<std::chrono::milliseconds>(timeout).count();
    if (ms > 0 && !parts_->inputs.has_more())
        SDL_WaitEventTimeout(nullptr, int(ms));
}

void DesktopWindow::wake() {
    if (parts_->woken.exchange(true))
        return;
    SDL_Event event{};
    event.type = parts_->wake_event;
    SDL_PushEvent(&event);
}

WindowInput DesktopWindow::poll() {
    SDL_Event event;
    parts_->awaits_owner = parts_->awaits_owner && parts_->inputs.has_more();
    while (!parts_->awaits_owner && SDL_PollEvent(&event))
        parts_->take(event);
    WindowInput input = parts_->inputs.take();
    // A release has its own place: a slow picture comes later, and the mouse may be elsewhere.
    if (!input.released)
        input.pointer.reset();
    if (!parts_->takes_text)
        read_held_keys(input.steering);
    if (!input.released && SDL_GetMouseFocus() == parts_->window) {
        int x = 0, y = 0;
        SDL_GetMouseState(&x, &y);
        input.pointer = parts_->shares_of(x, y);
    }
    if (parts_->takes_text) {
        input.aims_teleport = input.points = input.talks = false;
        return input;
    }
    const Uint8* held = SDL_GetKeyboardState(nullptr);
    input.aims_teleport = held[SDL_SCANCODE_T] != 0;
    input.points = held[SDL_SCANCODE_F] != 0;
    input.talks = held[SDL_SCANCODE_RETURN] != 0 || held[SDL_SCANCODE_KP_ENTER] != 0;
    return input;
}

FormInput DesktopWindow::poll_form() {
    FormInput input;
    SDL_Event event;
    while (SDL_PollEvent(&event)) {
        if (event.type == parts_->wake_event) {
            parts_->woken = false;
        } else if (event.type == SDL_QUIT) {
            input.close = true;
        } else if (event.type == SDL_TEXTINPUT) {
            input.keys.push_back({FormKey::letters, false, false, event.text.text});
        } else if (event.type == SDL_KEYDOWN) {
            const SDL_Keysym& pressed = event.key.keysym;
            if (const auto key = form_key(pressed))
                input.keys.push_back(
                    {*key, (pressed.mod & KMOD_CTRL) != 0, (pressed.mod & KMOD_SHIFT) != 0, {}});
        } else if (event.type == SDL_MOUSEBUTTONDOWN) {
            input.clicked = input.clicked || event.button.button == SDL_BUTTON_LEFT;
        } else if (event.type == SDL_MOUSEMOTION || event.type == SDL_MOUSEBUTTONUP ||
                   event.type == SDL_WINDOWEVENT) {
            input.redraw = true;
        } else if (event.type == SDL_MOUSEWHEEL) {
            input.wheel += event.wheel.preciseY;
        }
    }
    int x = 0, y = 0;
    const bool is_down = (SDL_GetMouseState(&x, &y) & SDL_BUTTON_LMASK) != 0;
    if (SDL_GetMouseFocus() == parts_->window) {
        input.pointer = parts_->shares_of(x, y);
        input.is_down = is_down;
    }
    return input;
}

void DesktopWindow::take_text(bool takes) {
    parts_->takes_text = takes;
}

std::string DesktopWindow::clipboard() const {
    char* const text = SDL_GetClipboardText();
    const std::string copy = text ? text : "";
    SDL_free(text);
    return copy;
}

void DesktopWindow::set_clipboard(const std::string& text) {
    SDL_SetClipboardText(text.c_str());
}

void DesktopWindow::Parts::take(const SDL_Event& event) {
    if (event.type == wake_event)
        woken = false;
    WindowInput& input = inputs.newest();
    switch (event.type) {
        case SDL_QUIT:
            input.close = true;
            break;
        case SDL_WINDOWEVENT:
            if (event.window.event == SDL_WINDOWEVENT_EXPOSED ||
                event.window.event == SDL_WINDOWEVENT_SIZE_CHANGED)
                input.redraw = true;
            break;
        case SDL_TEXTINPUT:
            if (takes_text)
                inputs.type({FormKey::letters, false, false, event.text.text});
            break;
        case SDL_KEYDOWN:
            awaits_owner = event.key.keysym.sym == SDLK_F3 ||
                           (takes_text && event.key.keysym.sym == SDLK_ESCAPE);
            if (takes_text && event.key.keysym.sym == SDLK_F3) {
                inputs.press({Action::chat});
            } else if (takes_text) {
                if (const auto key = form_key(event.key.keysym))
                    inputs.type({*key,
                                 (event.key.keysym.mod & KMOD_CTRL) != 0,
                                 (event.key.keysym.mod & KMOD_SHIFT) != 0,
                                 {}});
            } else if (const auto key = pressed(event.key.keysym);
                       key && (event.key.repeat == 0 || key->action == Action::nudge))
                inputs.press(*key);
            break;
        case SDL_MOUSEMOTION: {
            const double height = window_height();
            const Vec2 way{event.motion.xrel / height, event.motion.yrel / height};
            Vec2* drag = nullptr;
            if (event.motion.state & SDL_BUTTON_LMASK)
                drag = &input.steering.turn;
            else if (event.motion.state & (SDL_BUTTON_RMASK | SDL_BUTTON_MMASK))
                drag = &input.steering.slide;
            if (drag)
                *drag = {drag->x + way.x, drag->y + way.y};
            break;
        }
        case SDL_MOUSEBUTTONDOWN:
            inputs.grab(shares_of(event.button.x, event.button.y),
                        event.button.button == SDL_BUTTON_LEFT);
            break;
        case SDL_MOUSEBUTTONUP:
            if (event.button.button == SDL_BUTTON_LEFT) {
                inputs.release();
                inputs.newest().pointer = shares_of(event.button.x, event.button.y);
            }
            break;
        case SDL_MOUSEWHEEL: {
            const double clicks = event.wheel.preciseY;
            const bool flipped = event.wheel.direction == SDL_MOUSEWHEEL_FLIPPED;
            input.steering.approach += flipped ? -clicks : clicks;
            break;
        }
        default:
            break;
    }
}

bool DesktopWindow::is_visible() const {
    return !(SDL_GetWindowFlags(parts_->window) & (SDL_WINDOW_MINIMIZED | SDL_WINDOW_HIDDEN));
}

Size DesktopWindow::pixels() const {
    Size size;
    SDL_GL_GetDrawableSize(parts_->window, &size.width, &size.height);
    return {std::max(size.width, 1), std::max(size.height, 1)};
}

double DesktopWindow::text_pixels() const {
    constexpr double normal = 18;  // on a screen of 96 dots per inch
    const double pixels_per_unit = pixels().height / parts_->window_height();
    float dpi = 0;
    const int display = SDL_GetWindowDisplayIndex(parts_->window);
    if (SDL_GetDisplayDPI(display, &dpi, nullptr, nullptr) != 0)
        dpi = 96;
    // A large picture on a wall is viewed from far away; dots per inch do not show that. Screens
    // report wrong sizes, so each of the two counts for a factor of three at most.
    const double scale =
        std::max({pixels_per_unit, std::min(dpi / 96.0, 3.0), pixels().height / 1200.0});
    return normal * std::clamp(scale, 1.0, 3.0);
}

Duration DesktopWindow::picture_time() const {
    SDL_DisplayMode mode{};
    const int display = SDL_GetWindowDisplayIndex(parts_->window);
    if (SDL_GetCurrentDisplayMode(display, &mode) != 0 || mode.refresh_rate <= 0)
        mode.refresh_rate = 60;
    return seconds_to_duration(1.0 / mode.refresh_rate);
}

std::uint32_t DesktopWindow::x11_number() const {
    return x11_window(parts_->window);
}

void DesktopWindow::set_title(const std::string& title) {
    SDL_SetWindowTitle(parts_->window, title.c_str());
}

void DesktopWindow::toggle_full_screen() {
    SDL_SetWindowFullscreen(parts_->window, is_full_screen() ? 0 : SDL_WINDOW_FULLSCREEN_DESKTOP);
}

void DesktopWindow::fill_screen() {
    SDL_ShowCursor(SDL_DISABLE);
    SDL_Rect screen;
    if (SDL_GetDisplayBounds(SDL_GetWindowDisplayIndex(parts_->window), &screen) == 0) {
        SDL_SetWindowPosition(parts_->window, screen.x, screen.y);
        SDL_SetWindowSize(parts_->window, screen.w, screen.h);
    }
    if (!is_full_screen())
        toggle_full_screen();
}

bool DesktopWindow::is_full_screen() const {
    return SDL_GetWindowFlags(parts_->window) & SDL_WINDOW_FULLSCREEN_DESKTOP;
}

void DesktopWindow::present() {
    SDL_GL_SwapWindow(parts_->window);
}

int DesktopWindow::gl_errors() const {
    return parts_->errors.count();
}

std::string DesktopWindow::first_gl_error() const {
    return parts_->errors.first();
}

}  // namespace theatron::window
