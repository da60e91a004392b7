// SPDX-License-Identifier: Apache-2.0
#include "window/window_cover_native.h"

#include <xcb/xcb.h>

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <optional>
#include <vector>

#include "base/steady_clock.h"
#include "window/font.h"
#include "window/text_picture_native.h"

namespace theatron::window {
namespace {

constexpr Duration look_every = std::chrono::milliseconds(200);
constexpr Rgb cover_ground{24, 26, 30}, cover_ink{255, 190, 70};

std::uint32_t pixel_of(Rgb color) {
    return 0xff000000u | std::uint32_t(color.r) << 16 | std::uint32_t(color.g) << 8 | color.b;
}

// A window inside of another one, which hides it.
class InnerWindow {
public:
    explicit InnerWindow(std::uint32_t outer)
        : outer_(outer), connection_(xcb_connect(nullptr, nullptr)) {}
    // The server takes away what belongs to the connection.
    ~InnerWindow() { xcb_disconnect(connection_); }
    InnerWindow(const InnerWindow&) = delete;
    InnerWindow& operator=(const InnerWindow&) = delete;

    // False if the other one cannot be covered.
    bool show(const std::string& words) {
        if (xcb_connection_has_error(connection_))
            return false;
        const std::unique_ptr<xcb_get_geometry_reply_t, decltype(&std::free)> geometry(
            xcb_get_geometry_reply(connection_, xcb_get_geometry(connection_, outer_), nullptr),
            std::free);
        if (!geometry)
            return false;
        const Size size{geometry->width, geometry->height};
        if (!inner_)
            make(size);
        const std::uint32_t place[] = {std::uint32_t(size.width), std::uint32_t(size.height),
                                       XCB_STACK_MODE_ABOVE};
        xcb_configure_window(
            connection_, inner_,
            XCB_CONFIG_WINDOW_WIDTH | XCB_CONFIG_WINDOW_HEIGHT | XCB_CONFIG_WINDOW_STACK_MODE,
            place);
        xcb_map_window(connection_, inner_);
        xcb_flush(connection_);  // it hides the picture before the letters are there
        write(words, size, geometry->depth);
        xcb_flush(connection_);
        return !xcb_connection_has_error(connection_);
    }

private:
    void make(Size size) {
        inner_ = xcb_generate_id(connection_);
        const std::uint32_t ground = pixel_of(cover_ground);
        xcb_create_window(connection_, XCB_COPY_FROM_PARENT, inner_, outer_, 0, 0,
                          std::uint16_t(size.width), std::uint16_t(size.height), 0,
                          XCB_WINDOW_CLASS_INPUT_OUTPUT, XCB_COPY_FROM_PARENT, XCB_CW_BACK_PIXEL,
                          &ground);
        context_ = xcb_generate_id(connection_);
        xcb_create_gc(connection_, context_, inner_, 0, nullptr);
    }

    // In the middle. A screen of other pixels shows the dark window alone.
    void write(const std::string& words, Size size, std::uint8_t depth) {
        const xcb_setup_t* const setup = xcb_get_setup(connection_);
        if (depth < 24 || setup->image_byte_order != XCB_IMAGE_ORDER_LSB_FIRST)
            return;
        if (!font_)
            font_ = render::load_font_atlas(text_font());
        constexpr double usual_share = 0.045, widest = 0.85;  // of the window
        const double capital =
            std::min(usual_share * size.height, widest * size.width / text_width(*font_, words, 1));
        if (capital < 2)
            return;
        if (words != words_ || size != size_) {
            xcb_clear_area(connection_, 0, inner_, 0, 0, 0, 0);
            picture_ = text_picture(*font_, words, capital, cover_ink, cover_ground);
            words_ = words;
            size_ = size;
        }
        const int left = (size.width - picture_.size.width) / 2;
        const int top = (size.height - picture_.size.height) / 2;
        std::vector<std::uint32_t> row(std::size_t(picture_.size.width));
        for (int y = 0; y < picture_.size.height; ++y) {
            const Rgb* const from = picture_.view().row(y);
            std::transform(from, from + row.size(), row.begin(), pixel_of);
            xcb_put_image(connection_, XCB_IMAGE_FORMAT_Z_PIXMAP, inner_, context_,
                          std::uint16_t(row.size()), 1, std::int16_t(left), std::int16_t(top + y),
                          0, depth, std::uint32_t(row.size() * sizeof(row[0])),
                          reinterpret_cast<const std::uint8_t*>(row.data()));
        }
    }

    const std::uint32_t outer_;
    xcb_connection_t* const connection_;
    xcb_window_t inner_ = 0;
    xcb_gcontext_t context_ = 0;
    std::optional<render::FontAtlas> font_;
    std::string words_;  // in the picture, for a window of this size
    Size size_;
    ColorImage picture_;
};

}  // namespace

WindowCover::WindowCover(std::uint32_t x11_window, std::function<std::string(Duration)> words,
                         std::function<void()> cannot_cover)
    : window_(x11_window),
      words_(std::move(words)),
      cannot_cover_(std::move(cannot_cover)),
      thread_([this] { run(); }) {}

WindowCover::~WindowCover() {
    {
        const std::lock_guard lock(mutex_);
        stops_ = true;
    }
    changed_.notify_all();
    thread_.join();
}

void WindowCover::beat() {
    const std::lock_guard lock(mutex_);
    watch_.beat(steady_now());
}

void WindowCover::rest() {
    const std::lock_guard lock(mutex_);
    watch_.rest();
}

void WindowCover::run() {
    std::optional<InnerWindow> cover;
    bool is_told = false;
    std::unique_lock lock(mutex_);
    while (!changed_.wait_for(lock, look_every, [this] { return stops_; })) {
        const std::optional<Duration> still = watch_.still(steady_now());
        lock.unlock();
        bool is_covered = false;
        if (!still) {
            cover.reset();
        } else if (window_ != 0) {
            if (!cover)
                cover.emplace(window_);
            is_covered = cover->show(words_(*still));
        }
        if (still && !is_covered && *still >= pace::uncovered_end_after && !is_told) {
            is_told = true;
            cannot_cover_();
        }
        lock.lock();
    }
}

}  // namespace theatron::window
