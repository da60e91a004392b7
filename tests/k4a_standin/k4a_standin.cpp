// SPDX-License-Identifier: Apache-2.0
// A stand-in for libk4a in tests: the same C interface, generated pictures, and failures on
// demand (standin_behaviour.h). It declares the interface a second time on purpose: a wrong
// layout in capture/k4a_api.h then fails the tests.
//
// Every buffer has exactly the size of its picture, so that sanitizers detect reads beyond it.
// If a false size is requested, the buffer keeps its true, smaller size.
#include <algorithm>
#include <chrono>
#include <cstring>
#include <fstream>
#include <sstream>
#include <string>
#include <thread>
#include <utility>

#include "standin_behaviour.h"
#include "standin_pictures.h"

namespace {

using standin::Behaviour;
using standin::Bytes;
using Clock = std::chrono::steady_clock;

enum Answer { ok = 0, failed = 1, too_small = 2, timed_out = 2 };

struct Configuration {
    int color_format, color_resolution, depth_mode, fps;
    bool synchronized_images_only;
    std::int32_t depth_delay_off_color_usec;
    int wired_sync_mode;
    std::uint32_t subordinate_delay_off_master_usec;
    bool disable_streaming_indicator;
};

struct Image {
    Bytes bytes;
    std::size_t told_size = 0;
    int format = 0, width = 0, height = 0, stride = 0;
    std::uint64_t device_us = 0, system_ns = 0;
};

struct Capture {
    Image* depth = nullptr;
    Image* color = nullptr;
};

struct Device {
    std::uint32_t index = 0;
    Behaviour behaviour;
    bool running = false;
    Configuration configuration{};
    Clock::time_point started;
    int step = 0;     // captures given; two per frame if colour comes separately
    int in_vain = 0;  // waits since the last capture
};

// The number of handles not released, and the calls that tests check.
int alive = 0;
std::string calls;

template <class T>
T* make() {
    ++alive;
    return new T();
}
template <class T>
void release(T* handle) {
    --alive;
    delete handle;
}

constexpr int periods_us[] = {200'000, 66'667, 33'333};
constexpr int depth_sizes[][2] = {{0, 0}, {320, 288}, {640, 576}, {512, 512}, {1024, 1024}};
constexpr int color_sizes[][2] = {{0, 0},       {1280, 720},  {1920, 1080}, {2560, 1440},
                                  {2048, 1536}, {3840, 2160}, {4096, 3072}};

void stamp(const Device& device, Image& image, int frame) {
    constexpr std::int64_t device_start_us = 5'000'000;
    const std::int64_t period = periods_us[device.configuration.fps];
    if (device.behaviour.text("device_clock", "") != "none")
        image.device_us = std::uint64_t(device_start_us + frame * period);
    const std::string clock = device.behaviour.text("clock", "steady");
    const auto count = [](auto now) {
        return std::uint64_t(
            std::chrono::duration_cast<std::chrono::nanoseconds>(now.time_since_epoch()).count());
    };
    if (clock == "steady")
        image.system_ns = count(Clock::now());
    if (clock == "wall")  // as in Orbbec's library, in whole milliseconds
        image.system_ns = count(std::chrono::system_clock::now()) / 1'000'000 * 1'000'000;
}

Image* depth_image(const Device& device, int frame) {
    const Behaviour& b = device.behaviour;
    const auto& size = depth_sizes[device.configuration.depth_mode];
    Image* image = make<Image>();
    image->format = int(b.number("depth_format", 4));
    image->stride = size[0] * 2 + int(b.number("padding", 0));
    image->bytes = standin::depth_picture(size[0], size[1], image->stride, frame);
    image->width = int(b.number("depth_width", size[0]));
    image->height = size[1];
    image->told_size = std::size_t(b.number("depth_bytes", long(image->bytes.size())));
    // A smaller stated size also shortens the buffer.
    image->bytes.resize(std::min(image->bytes.size(), image->told_size));
    image->bytes.shrink_to_fit();
    image->stride = int(b.number("depth_stride", image->stride));
    stamp(device, *image, frame);
    return image;
}

Image* color_image(const Device& device, int frame) {
    const Behaviour& b = device.behaviour;
    const auto& size = color_sizes[device.configuration.color_resolution];
    Image* image = make<Image>();
    image->format = int(b.number("color_format", 0));
    image->bytes = standin::color_picture(size[0], size[1], frame);
    if (b.has("not_jpeg"))
        std::fill(image->bytes.begin(), image->bytes.end(), std::uint8_t(7));
    image->width = size[0];
    image->height = size[1];
    image->told_size = std::size_t(b.number("color_bytes", long(image->bytes.size())));
    image->bytes.resize(std::min(image->bytes.size(), image->told_size));
    image->bytes.shrink_to_fit();
    stamp(device, *image, frame);
    if (image->device_us != 0)
        image->device_us += std::uint64_t(b.number("color_later_us", 0));
    return image;
}

// The next capture: both pictures, or one after the other.
Capture* capture_of(const Device& device, int frame, int half) {
    const Behaviour& b = device.behaviour;
    const bool apart = b.has("apart") || b.has("color_first");
    const int depth_half = b.has("color_first") ? 1 : 0;
    Capture* capture = make<Capture>();
    if (!b.has("no_depth") && (!apart || half == depth_half))
        capture->depth = depth_image(device, frame);
    const bool color = device.configuration.color_resolution != 0 && !b.has("no_color") &&
                       frame != b.number("skip_color", -1);
    if (color && (!apart || half != depth_half))
        capture->color = color_image(device, frame);
    return capture;
}

// True for configurations that the real library accepts.
bool is_possible(const Configuration& c) {
    const bool depth = c.depth_mode != 0, color = c.color_resolution != 0;
    if (c.color_format < 0 || c.color_format > 3 || c.color_resolution < 0 ||
        c.color_resolution > 6 || c.depth_mode < 0 || c.depth_mode > 4 || c.fps < 0 || c.fps > 2)
        return false;
    if (c.wired_sync_mode != 2 && c.subordinate_delay_off_master_usec != 0)
        return false;
    if (c.wired_sync_mode == 1 && !color)
        return false;
    if (c.fps == 2 && (c.depth_mode == 4 || c.color_resolution == 6))
        return false;
    return (depth || color) && (!c.synchronized_images_only || (depth && color));
}

int give(const std::string& text, void* out, std::size_t* size) {
    const std::size_t room = *size;
    *size = text.size() + 1;
    if (!out || room < *size)
        return too_small;
    std::memcpy(out, text.c_str(), *size);
    return ok;
}

}  // namespace

#define STANDIN_EXPORT extern "C" __attribute__((visibility("default")))

// For tests: the number of handles not released, and the calls since the last query.
STANDIN_EXPORT int k4a_standin_alive() {
    return alive;
}
STANDIN_EXPORT const char* k4a_standin_take_calls() {
    static std::string taken;
    taken = std::exchange(calls, "");
    return taken.c_str();
}

STANDIN_EXPORT std::uint32_t k4a_device_get_installed_count() {
    return std::uint32_t(Behaviour::from_environment().number("devices", 1));
}

STANDIN_EXPORT int k4a_device_open(std::uint32_t index, Device** device) {
    const Behaviour behaviour = Behaviour::from_environment();
    if (behaviour.has("refuse_open") || long(index) >= behaviour.number("devices", 1))
        return failed;
    *device = make<Device>();
    (*device)->index = index;
    (*device)->behaviour = behaviour;
    return ok;
}

STANDIN_EXPORT void k4a_device_close(Device* device) {
    calls += "close;";
    release(device);
}

STANDIN_EXPORT int k4a_device_get_serialnum(Device* device, char* text, std::size_t* size) {
    return give("00012345" + std::to_string(device->index), text, size);
}

STANDIN_EXPORT int k4a_device_get_raw_calibration(Device* device, std::uint8_t* bytes,
                                                  std::size_t* size) {
    const std::string which = device->behaviour.text("calibration", "");
    if (which == "none")
        return failed;
    if (which == "garbage")
        return give("{\"CalibrationInformation\": 7", bytes, size);
    if (which == "long")
        return give(standin::calibration() + std::string(200'000, ' '), bytes, size);
    if (which.empty())
        return give(standin::calibration(), bytes, size);
    std::ostringstream text;
    text << std::ifstream(which).rdbuf();
    return give(text.str(), bytes, size);
}

STANDIN_EXPORT int k4a_device_set_color_control(Device* device, int control, int mode,
                                                std::int32_t value) {
    calls += "control " + std::to_string(control) + " " + std::to_string(mode) + " " +
             std::to_string(value) + ";";
    return device->behaviour.has("refuse_controls") ? failed : ok;
}

STANDIN_EXPORT int k4a_device_start_cameras(Device* device, const Configuration* c) {
    std::ostringstream line;
    line << "start format=" << c->color_format << " color=" << c->color_resolution
         << " depth=" << c->depth_mode << " fps=" << c->fps
         << " synchronized=" << c->synchronized_images_only
         << " depth_delay=" << c->depth_delay_off_color_usec << " sync=" << c->wired_sync_mode
         << " delay=" << c->subordinate_delay_off_master_usec
         << " dark=" << c->disable_streaming_indicator << ";";
    calls += line.str();
    if (device->behaviour.has("refuse_start") || !is_possible(*c))
        return failed;
    device->configuration = *c;
    device->running = true;
    device->started = Clock::now();
    return ok;
}

STANDIN_EXPORT void k4a_device_stop_cameras(Device* device) {
    calls += "stop;";
    device->running = false;
}

STANDIN_EXPORT int k4a_device_get_capture(Device* device, Capture** capture, std::int32_t ms) {
    const Behaviour& b = device->behaviour;
    const int captures_a_frame = b.has("apart") || b.has("color_first") ? 2 : 1;
    const int frame = device->step / captures_a_frame;
    const long forever = 1L << 40;
    if (!device->running || frame >= b.number("unplug_after", forever))
        return failed;
    if (device->in_vain < b.number("in_vain", 0)) {
        ++device->in_vain;
        return timed_out;
    }
    const auto deadline = Clock::now() + std::chrono::milliseconds(ms);
    const std::chrono::microseconds period(
        b.number("period_us", periods_us[device->configuration.fps]));
    const auto due = device->started + (frame + 1) * period;
    if (frame >= b.number("stall_after", forever) || due > deadline) {
        std::this_thread::sleep_until(deadline);
        return timed_out;
    }
    std::this_thread::sleep_until(due);
    *capture = capture_of(*device, frame, device->step % captures_a_frame);
    ++device->step;
    device->in_vain = 0;
    return ok;
}

STANDIN_EXPORT void k4a_capture_release(Capture* capture) {
    if (capture->depth)
        release(capture->depth);
    if (capture->color)
        release(capture->color);
    release(capture);
}

// In the real library images outlive their capture; here they are copies.
STANDIN_EXPORT Image* k4a_capture_get_depth_image(Capture* capture) {
    if (!capture->depth)
        return nullptr;
    Image* image = make<Image>();
    *image = *capture->depth;
    return image;
}
STANDIN_EXPORT Image* k4a_capture_get_color_image(Capture* capture) {
    if (!capture->color)
        return nullptr;
    Image* image = make<Image>();
    *image = *capture->color;
    return image;
}

STANDIN_EXPORT std::uint8_t* k4a_image_get_buffer(Image* image) {
    return image->bytes.data();
}
STANDIN_EXPORT std::size_t k4a_image_get_size(Image* image) {
    return image->told_size;
}
STANDIN_EXPORT int k4a_image_get_format(Image* image) {
    return image->format;
}
STANDIN_EXPORT int k4a_image_get_width_pixels(Image* image) {
    return image->width;
}
STANDIN_EXPORT int k4a_image_get_height_pixels(Image* image) {
    return image->height;
}
STANDIN_EXPORT int k4a_image_get_stride_bytes(Image* image) {
    return image->stride;
}
STANDIN_EXPORT std::uint64_t k4a_image_get_device_timestamp_usec(Image* image) {
    return image->device_us;
}
STANDIN_EXPORT std::uint64_t k4a_image_get_system_timestamp_nsec(Image* image) {
    return image->system_ns;
}
STANDIN_EXPORT void k4a_image_release(Image* image) {
    release(image);
}
