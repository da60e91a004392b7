// SPDX-License-Identifier: Apache-2.0
#include "capture/x11_windows.h"

#include <X11/Xauth.h>
#include <fcntl.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>
#include <xcb/xcb.h>

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <string_view>

#include "base/error.h"
#include "base/small_letters.h"
#include "capture/x11_reply.h"

namespace theatron::capture {
namespace {

constexpr unsigned most_windows = 1000;
constexpr std::uint32_t most_title_words = 64;  // of four bytes

class Display {
public:
    Display() : connection_(xcb_connect(nullptr, &screen_number_)) {
        if (xcb_connection_has_error(connection_)) {
            xcb_disconnect(connection_);
            const char* name = std::getenv("DISPLAY");
            throw Error(name && *name ? "The display " + std::string(name) + " does not answer."
                                      : std::string("There is no X display (DISPLAY is not set)."));
        }
        auto screens = xcb_setup_roots_iterator(xcb_get_setup(connection_));
        for (int i = 0; i < screen_number_ && screens.rem > 1; ++i)
            xcb_screen_next(&screens);
        root_ = screens.data->root;
        size_ = {screens.data->width_in_pixels, screens.data->height_in_pixels};
    }
    ~Display() { xcb_disconnect(connection_); }
    Display(const Display&) = delete;

    Size size() const { return size_; }

    // The windows of programs: as the window manager lists them, else the children of the root.
    std::vector<xcb_window_t> windows() {
        const auto bytes = property(root_, atom("_NET_CLIENT_LIST"), most_windows);
        std::vector<xcb_window_t> all(bytes.size() / sizeof(xcb_window_t));
        std::memcpy(all.data(), bytes.data(), all.size() * sizeof(xcb_window_t));
        if (!all.empty())
            return all;
        const Reply<xcb_query_tree_reply_t> tree(
            xcb_query_tree_reply(connection_, xcb_query_tree(connection_, root_), nullptr));
        if (tree) {
            const auto* const children = xcb_query_tree_children(tree.get());
            all.assign(children, children + std::min<unsigned>(tree->children_len, most_windows));
        }
        return all;
    }

    // Number 0: the window is gone, invisible, or no program's.
    X11Window describe(xcb_window_t window) {
        X11Window found;
        const Reply<xcb_get_window_attributes_reply_t> attributes(xcb_get_window_attributes_reply(
            connection_, xcb_get_window_attributes(connection_, window), nullptr));
        const Reply<xcb_get_geometry_reply_t> geometry(
            xcb_get_geometry_reply(connection_, xcb_get_geometry(connection_, window), nullptr));
        if (!attributes || !geometry || attributes->map_state != XCB_MAP_STATE_VIEWABLE ||
            attributes->_class != XCB_WINDOW_CLASS_INPUT_OUTPUT)
            return found;
        found.title = property(window, atom("_NET_WM_NAME"), most_title_words);
        if (found.title.empty())
            found.title = property(window, XCB_ATOM_WM_NAME, most_title_words);
        // Two texts, of which the second is the class.
        const std::string names = property(window, XCB_ATOM_WM_CLASS, most_title_words);
        const auto end = names.find('\0');
        found.program = end == std::string::npos ? names : names.substr(end + 1);
        for (std::string* text : {&found.title, &found.program})
            std::erase_if(*text,
                          [](char c) { return std::iscntrl(static_cast<unsigned char>(c)); });
        if (found.program.empty())
            found.program = "window";
        if (!found.title.empty() || !names.empty())
            found.number = window;
        found.size = {geometry->width, geometry->height};
        if (const std::string id = property(window, atom("_NET_WM_PID"), 1);
            id.size() == sizeof(found.process))
            std::memcpy(&found.process, id.data(), sizeof(found.process));
        return found;
    }

private:
    xcb_atom_t atom(std::string_view name) {
        const Reply<xcb_intern_atom_reply_t> reply(xcb_intern_atom_reply(
            connection_, xcb_intern_atom(connection_, 1, std::uint16_t(name.size()), name.data()),
            nullptr));
        return reply ? reply->atom : xcb_atom_t(XCB_ATOM_NONE);
    }

    std::string property(xcb_window_t window, xcb_atom_t name, std::uint32_t words) {
        if (name == XCB_ATOM_NONE)
            return "";
        const Reply<xcb_get_property_reply_t> reply(xcb_get_property_reply(
            connection_,
            xcb_get_property(connection_, 0, window, name, XCB_GET_PROPERTY_TYPE_ANY, 0, words),
            nullptr));
        if (!reply)
            return "";
        return {static_cast<const char*>(xcb_get_property_value(reply.get())),
                std::size_t(xcb_get_property_value_length(reply.get()))};
    }

    int screen_number_ = 0;
    xcb_connection_t* connection_;
    xcb_window_t root_{};
    Size size_;
};

std::string hex(const char* bytes, int count) {
    std::string text;
    for (int i = 0; i < count; ++i) {
        char digits[3];
        std::snprintf(digits, sizeof(digits), "%02x", unsigned(std::uint8_t(bytes[i])));
        text += digits;
    }
    return text;
}

// The cookie of the user's authority file for display `number`; empty: there is none.
std::string cookie_for(int number) {
    char machine[256] = {};
    gethostname(machine, sizeof(machine) - 1);
    const std::string display = std::to_string(number);
    constexpr std::string_view method = "MIT-MAGIC-COOKIE-1";
    Xauth* const found =
        XauGetAuthByAddr(FamilyLocal, static_cast<unsigned short>(std::strlen(machine)), machine,
                         static_cast<unsigned short>(display.size()), display.c_str(),
                         static_cast<unsigned short>(method.size()), method.data());
    if (!found)
        return "";
    const std::string cookie = hex(found->data, found->data_length);
    XauDisposeAuth(found);
    return cookie;
}

}  // namespace

bool is_same_window(const X11Window& shared, const X11Window& found) {
    // The title of a window may change while it is away, for example minimised.
    const bool is_as_before = shared.number == found.number && shared.process == found.process;
    return shared.program == found.program && (is_as_before || shared.title == found.title);
}

std::string number_text(std::uint32_t window) {
    char text[16];
    std::snprintf(text, sizeof(text), "0x%x", window);
    return text;
}

std::vector<X11Window> list_windows() {
    Display display;
    std::vector<X11Window> found;
    for (const xcb_window_t window : display.windows())
        if (X11Window one = display.describe(window); one.number != 0)
            found.push_back(std::move(one));
    return found;
}

X11Window find_window(const std::string& text) {
    Display display;
    if (text == "display")
        return {0, "", "display", display.size(), 0};
    const bool is_hex = text.starts_with("0x");
    std::uint32_t number = 0;
    const char* const begin = text.data() + (is_hex ? 2 : 0);
    const char* const end = text.data() + text.size();
    if (const auto read = std::from_chars(begin, end, number, is_hex ? 16 : 10);
        read.ec == std::errc{} && read.ptr == end) {
        X11Window found = display.describe(number);
        if (found.size == Size{})
            throw Error("There is no visible window " + text +
                        "; 'theatron cameras' lists the windows.");
        found.number = number;
        return found;
    }
    std::vector<X11Window> fitting;
    for (const X11Window& one : list_windows())
        if (in_small_letters(one.title + "\n" + one.program).find(in_small_letters(text)) !=
            std::string::npos)
            fitting.push_back(one);
    if (fitting.empty())
        throw Error("There is no visible window '" + text +
                    "'; 'theatron cameras' lists the windows.");
    if (fitting.size() > 1)
        throw Error("There are " + std::to_string(fitting.size()) + " windows '" + text +
                    "'; name one by its number, for example x11:" + number_text(fitting[0].number) +
                    ". 'theatron cameras' lists them.");
    return fitting[0];
}

X11Connection connect_to_x11() {
    char* host = nullptr;
    int number = 0, screen = 0;
    if (!xcb_parse_display(nullptr, &host, &number, &screen))
        throw Error("There is no X display (DISPLAY is not set).");
    const std::string machine = host ? host : "";
    std::free(host);
    const std::string display = machine + ":" + std::to_string(number);
    if (!machine.empty() && machine != "unix")
        throw Error("The display " + display +
                    " is on another machine; share it with a program that runs there.");
    SourceInput input(socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0));
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::snprintf(address.sun_path, sizeof(address.sun_path), "/tmp/.X11-unix/X%d", number);
    if (connect(input.descriptor(), reinterpret_cast<const sockaddr*>(&address), sizeof(address)) !=
        0)
        throw Error("The display " + display + " does not answer.");
    // As the library in the reader needs it.
    fcntl(input.descriptor(), F_SETFL, O_NONBLOCK);
    return {std::move(input), display, screen, cookie_for(number)};
}

}  // namespace theatron::capture
