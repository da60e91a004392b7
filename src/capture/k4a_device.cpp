// SPDX-License-Identifier: Apache-2.0
#include "capture/k4a_device.h"

#include <algorithm>

#include "base/error.h"
#include "base/log.h"
#include "capture/azure_calibration.h"
#include "video/jpeg_header.h"

namespace theatron::capture::k4a {
namespace {

constexpr const char* how_to_permit =
    "close other programs that use it, and if it never worked for this user, copy the camera's "
    "udev rules (99-k4a.rules for Azure Kinect, 99-obsensor-libusb.rules for Orbbec) to "
    "/etc/udev/rules.d, run 'udevadm control --reload-rules' as root and plug it in again";

constexpr std::size_t max_serial_bytes = 256;
constexpr std::size_t max_calibration_bytes = 1 << 20;
constexpr std::size_t max_jpeg_bytes = 64 << 20;

DevicePtr open_index(const Library& library, std::uint32_t index) {
    DeviceObject* device = nullptr;
    if (library.device_open(index, &device) != Outcome::succeeded)
        device = nullptr;
    return {device, {library.device_close}};
}

// Empty if the device does not provide it.
std::string read_serial(const Library& library, DeviceObject* device) {
    std::string text(max_serial_bytes, '\0');
    std::size_t size = text.size();
    if (library.device_get_serialnum(device, text.data(), &size) != BufferResult::succeeded)
        return {};
    text.resize(std::min(size, max_serial_bytes));
    // Keeps letters and digits: the serial number becomes part of names and log lines.
    const auto end = std::find_if(text.begin(), text.end(), [](char c) {
        return !((c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z'));
    });
    text.erase(end, text.end());
    return text;
}

std::string how_many(std::uint32_t devices) {
    if (devices == 0)
        return "no camera of this kind is plugged in";
    return devices == 1 ? "1 camera is plugged in" : std::to_string(devices) + " are plugged in";
}

// The calibration's JSON; empty if the device does not provide it.
std::string read_calibration(const Library& library, DeviceObject* device) {
    constexpr std::size_t usual_bytes = 1 << 16;
    std::string text(usual_bytes, '\0');
    while (true) {
        std::size_t size = text.size();
        auto* bytes = reinterpret_cast<std::uint8_t*>(text.data());
        const BufferResult result = library.device_get_raw_calibration(device, bytes, &size);
        if (result == BufferResult::too_small && size > text.size() &&
            size <= max_calibration_bytes) {
            text.resize(size);
            continue;
        }
        if (result != BufferResult::succeeded)
            return {};
        text.resize(std::min(size, text.size()));
        // The size may or may not include a terminating zero.
        text.resize(std::min(text.size(), text.find('\0')));
        return text;
    }
}

}  // namespace

FoundDevices find_devices() {
    FoundDevices found;
    Library library;
    try {
        library = load_library();
    } catch (const Error& problem) {
        found.problem = problem.what();
        return found;
    }
    constexpr std::uint32_t most = 64;
    const std::uint32_t count = std::min(library.device_get_installed_count(), most);
    for (std::uint32_t index = 0; index < count; ++index) {
        FoundDevice device{.index = index, .serial = {}, .problem = {}};
        if (const DevicePtr opened = open_index(library, index))
            device.serial = read_serial(library, opened.get());
        else
            device.problem = std::string("It cannot be opened: ") + how_to_permit + ".";
        found.devices.push_back(std::move(device));
    }
    return found;
}

OpenDevice::OpenDevice(const Library& library, const Settings& settings)
    : library_(library), name_(settings.name()) {
    open(settings);
    serial_ = read_serial(library_, device_.get());
}

OpenDevice::~OpenDevice() {
    if (started_)
        library_.device_stop_cameras(device_.get());
}

void OpenDevice::open(const Settings& settings) {
    const std::uint32_t count = library_.device_get_installed_count();
    const bool by_serial = !settings.serial.empty();
    const std::uint32_t first = by_serial ? 0 : settings.index;
    const std::uint32_t last = by_serial ? count : settings.index + 1;
    if (count == 0 || (!by_serial && settings.index >= count))
        throw Error("There is no camera '" + name_ + "': " + how_many(count) +
                    "; look at its cable and its power supply, and run 'theatron cameras'.");
    bool any_refused = false;
    for (std::uint32_t index = first; index < last; ++index) {
        device_ = open_index(library_, index);
        any_refused |= !device_;
        if (device_ && (!by_serial || read_serial(library_, device_.get()) == settings.serial))
            return;
    }
    device_.reset();
    if (any_refused)
        throw Error("The camera '" + name_ + "' cannot be opened: " + how_to_permit + ".");
    throw Error("There is no camera '" + name_ + "': " + how_many(count) +
                ", with other serial numbers; run 'theatron cameras'.");
}

Calibration OpenDevice::calibration(const Settings& settings) const {
    const std::string text = read_calibration(library_, device_.get());
    // Orbbec's library accesses the device here for the first time, so missing permissions
    // show here as well.
    if (text.empty())
        throw Error("The camera '" + name_ +
                    "' does not give its calibration: " + std::string(how_to_permit) + ".");
    const ParsedCalibration parsed = parse_azure_calibration(text, settings.depth, settings.color);
    if (!parsed.problem.empty())
        throw Error("The calibration in the camera '" + name_ + "' " + parsed.problem + ".");
    return parsed.calibration;
}

void OpenDevice::set_controls(const Settings& settings) const {
    for (const ControlSetting& c : settings.controls) {
        if (library_.device_set_color_control(device_.get(), c.control, c.mode, c.value) ==
            Outcome::succeeded)
            continue;
        if (c.asked_for)
            throw Error("The camera '" + name_ + "' refuses " + c.option + "=" +
                        (c.mode == ControlMode::automatic ? "auto" : std::to_string(c.value)) +
                        ".");
        log::warning("capture", "a control of the camera cannot be set and stays as it was",
                     {{"camera", name_}, {"control", c.option}});
    }
}

void OpenDevice::start(const Settings& settings) {
    set_controls(settings);
    if (library_.device_start_cameras(device_.get(), &settings.configuration) != Outcome::succeeded)
        throw Error("The camera '" + name_ +
                    "' does not start: check that it is on a USB 3 port of its own controller, "
                    "that its power supply is plugged in, and that the program runs with a "
                    "display (DISPLAY), which the camera's depth engine needs for OpenGL.");
    started_ = true;
}

WaitResult OpenDevice::wait(Duration timeout, CapturePtr& capture) const {
    // A negative number would mean an infinite wait.
    const auto ms = std::chrono::duration_cast<std::chrono::milliseconds>(timeout).count();
    const auto bounded = std::int32_t(std::clamp<std::int64_t>(ms, 0, 60'000));
    CaptureObject* got = nullptr;
    const WaitResult result = library_.device_get_capture(device_.get(), &got, bounded);
    capture =
        CapturePtr(result == WaitResult::succeeded ? got : nullptr, {library_.capture_release});
    return result;
}

ImagePtr OpenDevice::depth_of(const CapturePtr& capture) const {
    return {library_.capture_get_depth_image(capture.get()), {library_.image_release}};
}

ImagePtr OpenDevice::color_of(const CapturePtr& capture) const {
    return {library_.capture_get_color_image(capture.get()), {library_.image_release}};
}

std::optional<DepthPicture> OpenDevice::depth_picture(const ImagePtr& image, Size size) const {
    ImageObject* const i = image.get();
    const Size given{library_.image_get_width_pixels(i), library_.image_get_height_pixels(i)};
    const int stride = library_.image_get_stride_bytes(i);
    const std::size_t row = std::size_t(size.width) * sizeof(std::uint16_t);
    if (library_.image_get_format(i) != ImageFormat::depth16 || given != size || stride < 0 ||
        std::size_t(stride) < row)
        return std::nullopt;
    const DepthPicture picture{library_.image_get_buffer(i), std::size_t(stride)};
    const std::size_t needed = picture.stride_bytes * std::size_t(size.height - 1) + row;
    if (!picture.bytes || library_.image_get_size(i) < needed)
        return std::nullopt;
    return picture;
}

std::optional<ByteView> OpenDevice::jpeg_picture(const ImagePtr& image, Size size) const {
    ImageObject* const i = image.get();
    const std::size_t bytes = library_.image_get_size(i);
    const std::uint8_t* buffer = library_.image_get_buffer(i);
    if (library_.image_get_format(i) != ImageFormat::mjpg || !buffer || bytes > max_jpeg_bytes)
        return std::nullopt;
    const ByteView jpeg(reinterpret_cast<const std::byte*>(buffer), bytes);
    const Result<Size> parsed = video::read_jpeg_size(jpeg);
    if (!parsed || *parsed != size)
        return std::nullopt;
    return jpeg;
}

Duration OpenDevice::device_time(const ImagePtr& image) const {
    // 285 years, an impossible time. Larger numbers would overflow later sums.
    constexpr std::uint64_t longest = std::uint64_t(1) << 53;
    const std::uint64_t us = library_.image_get_device_timestamp_usec(image.get());
    return us < longest ? Duration(std::int64_t(us)) : Duration(0);
}

std::uint64_t OpenDevice::system_ns(const ImagePtr& image) const {
    return library_.image_get_system_timestamp_nsec(image.get());
}

}  // namespace theatron::capture::k4a
