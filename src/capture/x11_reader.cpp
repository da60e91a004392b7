// SPDX-License-Identifier: Apache-2.0
// Pictures of an X11 window or of a whole screen, over a connection that the parent opened.
//
// A window is read from the memory that the Composite extension keeps for it, so what lies over it
// is never shared.
#include <xcb/composite.h>
#include <xcb/xcb.h>
#include <xcb/xfixes.h>

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>

#include "base/steady_clock.h"
#include "capture/av_video.h"
#include "capture/source_readers.h"
#include "capture/source_request.h"
#include "capture/x11_reply.h"

namespace theatron::capture {
namespace {

using Kind = VideoAnswer::Kind;

constexpr std::uint32_t all_planes = ~std::uint32_t(0);
constexpr unsigned pixel_bytes = 4;

class Grabber {
public:
    Grabber(const SourceOpening& opening, sandbox::Inside& inside)
        : wanted_(opening.wanted),
          frames_per_second_(opening.frames_per_second),
          input_(inside.input()),
          writer_(inside.area()) {
        char cookie[257] = {};
        int cursor = 0;
        std::sscanf(opening.text.c_str(), "%d %u %d %256s", &screen_number_, &window_, &cursor,
                    cookie);
        with_cursor_ = cursor == 1;
        for (std::size_t i = 0; cookie[i] && cookie[i + 1]; i += 2) {
            unsigned byte = 0;
            std::from_chars(cookie + i, cookie + i + 2, byte, 16);
            cookie_.push_back(char(byte));
        }
    }

    VideoAnswer open();
    std::optional<VideoAnswer> next();

private:
    template <class Extension>
    bool has(Extension& extension) {
        const auto* const facts = xcb_get_extension_data(connection_, &extension);
        return facts && facts->present;
    }
    bool has_usual_pixels() const;
    bool grab();
    void draw_cursor(std::uint8_t* pixels, Size size);

    Size wanted_;
    double frames_per_second_;
    int input_, screen_number_ = 0;
    unsigned window_ = 0;  // 0: the root
    bool with_cursor_ = false, has_fixes_ = false, has_composite_ = false;
    std::string cookie_;
    xcb_connection_t* connection_ = nullptr;
    const xcb_screen_t* screen_ = nullptr;
    xcb_pixmap_t pixmap_{};
    PictureWriter writer_;
};

// 32 bits a pixel: blue, green, red and one unused byte.
bool Grabber::has_usual_pixels() const {
    const xcb_setup_t* const setup = xcb_get_setup(connection_);
    if (setup->image_byte_order != XCB_IMAGE_ORDER_LSB_FIRST)
        return false;
    for (auto format = xcb_setup_pixmap_formats_iterator(setup); format.rem;
         xcb_format_next(&format))
        if (format.data->depth == screen_->root_depth)
            return screen_->root_depth >= 24 && format.data->bits_per_pixel == 8 * pixel_bytes;
    return false;
}

VideoAnswer Grabber::open() {
    char method[] = "MIT-MAGIC-COOKIE-1";
    xcb_auth_info_t authority{int(std::strlen(method)), method, int(cookie_.size()),
                              cookie_.data()};
    connection_ = xcb_connect_to_fd(input_, cookie_.empty() ? nullptr : &authority);
    if (xcb_connection_has_error(connection_))
        return {.kind = Kind::refused};
    auto screens = xcb_setup_roots_iterator(xcb_get_setup(connection_));
    for (int i = 0; i < screen_number_ && screens.rem > 1; ++i)
        xcb_screen_next(&screens);
    screen_ = screens.data;
    if (!screen_ || !has_usual_pixels())
        return {.kind = Kind::no_decoder};
    // Requests of an extension are answered after its version was asked for.
    has_composite_ = window_ != 0 && has(xcb_composite_id);
    if (has_composite_) {
        const Reply<xcb_composite_query_version_reply_t> version(xcb_composite_query_version_reply(
            connection_, xcb_composite_query_version(connection_, 0, 4), nullptr));
        xcb_composite_redirect_window(connection_, window_, XCB_COMPOSITE_REDIRECT_AUTOMATIC);
        pixmap_ = xcb_generate_id(connection_);
    }
    has_fixes_ = with_cursor_ && has(xcb_xfixes_id);
    if (has_fixes_) {
        const Reply<xcb_xfixes_query_version_reply_t> version(xcb_xfixes_query_version_reply(
            connection_, xcb_xfixes_query_version(connection_, 4, 0), nullptr));
    }
    Size size{screen_->width_in_pixels, screen_->height_in_pixels};
    if (window_ != 0) {
        const Reply<xcb_get_geometry_reply_t> geometry(
            xcb_get_geometry_reply(connection_, xcb_get_geometry(connection_, window_), nullptr));
        if (!geometry)
            return {.kind = Kind::hidden};
        size = {geometry->width, geometry->height};
    }
    if (!writer_.begin(wanted_ == Size{} ? size : wanted_))
        return {.kind = Kind::impossible_size};
    return grab() ? VideoAnswer{Kind::opened, {}, writer_.size(), frames_per_second_}
                  : VideoAnswer{.kind = Kind::hidden, .size = {}};
}

// The pointer of the mouse, which is no part of a window's pixels.
void Grabber::draw_cursor(std::uint8_t* pixels, Size size) {
    const Reply<xcb_xfixes_get_cursor_image_reply_t> cursor(xcb_xfixes_get_cursor_image_reply(
        connection_, xcb_xfixes_get_cursor_image(connection_), nullptr));
    if (!cursor)
        return;
    int left = cursor->x - cursor->xhot, top = cursor->y - cursor->yhot;
    if (window_ != 0) {
        const Reply<xcb_translate_coordinates_reply_t> place(xcb_translate_coordinates_reply(
            connection_,
            xcb_translate_coordinates(connection_, screen_->root, window_, std::int16_t(left),
                                      std::int16_t(top)),
            nullptr));
        // Over another window the pointer belongs there.
        const Reply<xcb_query_pointer_reply_t> pointer(
            xcb_query_pointer_reply(connection_, xcb_query_pointer(connection_, window_), nullptr));
        if (!place || !pointer || pointer->win_x < 0 || pointer->win_y < 0 ||
            pointer->win_x >= size.width || pointer->win_y >= size.height)
            return;
        left = place->dst_x;
        top = place->dst_y;
    }
    const std::uint32_t* const image = xcb_xfixes_get_cursor_image_cursor_image(cursor.get());
    for (int y = std::max(0, -top); y < cursor->height && top + y < size.height; ++y)
        for (int x = std::max(0, -left); x < cursor->width && left + x < size.width; ++x) {
            // Premultiplied.
            const std::uint32_t argb = image[y * cursor->width + x];
            const unsigned through = 255 - (argb >> 24);
            std::uint8_t* const pixel =
                pixels + pixel_bytes * (std::size_t(top + y) * std::size_t(size.width) +
                                        std::size_t(left + x));
            for (unsigned channel = 0; channel < 3; ++channel)
                pixel[channel] = std::uint8_t(
                    std::min(255u, (argb >> (8 * channel) & 255) + pixel[channel] * through / 255));
        }
}

// The present picture into the area; false if the window has none.
bool Grabber::grab() {
    Size size{screen_->width_in_pixels, screen_->height_in_pixels};
    int border = 0;
    xcb_drawable_t source = screen_->root;
    if (window_ != 0) {
        const Reply<xcb_get_geometry_reply_t> geometry(
            xcb_get_geometry_reply(connection_, xcb_get_geometry(connection_, window_), nullptr));
        if (!geometry)
            return false;
        size = {geometry->width, geometry->height};
        source = window_;
        if (has_composite_) {
            border = geometry->border_width;
            // A window has another pixmap whenever it changes its size or is shown again.
            xcb_composite_name_window_pixmap(connection_, window_, pixmap_);
            source = pixmap_;
        }
    }
    const Reply<xcb_get_image_reply_t> image(xcb_get_image_reply(
        connection_,
        xcb_get_image(connection_, XCB_IMAGE_FORMAT_Z_PIXMAP, source, std::int16_t(border),
                      std::int16_t(border), std::uint16_t(size.width), std::uint16_t(size.height),
                      all_planes),
        nullptr));
    if (has_composite_)
        xcb_free_pixmap(connection_, pixmap_);
    const std::size_t bytes = pixel_bytes * size.area();
    if (!image || std::size_t(xcb_get_image_data_length(image.get())) < bytes)
        return false;
    std::uint8_t* const pixels = xcb_get_image_data(image.get());
    if (has_fixes_)
        draw_cursor(pixels, size);
    const std::uint8_t* const rows[] = {pixels, nullptr, nullptr, nullptr};
    const int strides[] = {int(pixel_bytes) * size.width, 0, 0, 0};
    writer_.write({AV_PIX_FMT_BGR0, size, rows, strides});
    // Errors of requests without replies would gather.
    while (const Reply<xcb_generic_event_t> event{xcb_poll_for_event(connection_)}) {
    }
    return true;
}

std::optional<VideoAnswer> Grabber::next() {
    if (xcb_connection_has_error(connection_))
        return std::nullopt;
    if (!grab())
        return VideoAnswer{.kind = Kind::hidden, .size = {}};
    return VideoAnswer{.kind = Kind::picture, .time = Duration(to_us(steady_now())), .size = {}};
}

}  // namespace

void serve_x11(sandbox::Inside& inside) {
    serve_source<Grabber>(inside);
}

}  // namespace theatron::capture
