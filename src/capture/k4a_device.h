// SPDX-License-Identifier: Apache-2.0
// Live devices: which there are, opening one, and its pictures as checked views.
//
// What a device or its library says about itself is not trusted: sizes are
// compared with what was asked for before a byte is read.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/bytes.h"
#include "capture/k4a_library.h"
#include "capture/k4a_settings.h"
#include "geometry/calibration.h"
#include "image/view.h"

namespace theatron::capture::k4a {

// A device as `theatron cameras` shows it.
struct FoundDevice {
    std::uint32_t index = 0;
    std::string serial;
    std::string problem;  // one sentence if it cannot be opened, as when it is in use
};
struct FoundDevices {
    std::vector<FoundDevice> devices;
    std::string problem;  // one sentence if the library is missing
};
// Opens each device for a moment. Does not throw.
FoundDevices find_devices();

// A depth picture with the padding of its rows.
struct DepthPicture {
    const std::uint8_t* bytes = nullptr;
    std::size_t stride_bytes = 0;
};

// One opened device; stopped and closed at the end.
class OpenDevice {
public:
    // Throws Error saying what to do where the device is missing, in use or not permitted.
    OpenDevice(const Library& library, const Settings& settings);
    ~OpenDevice();
    OpenDevice(const OpenDevice&) = delete;
    OpenDevice& operator=(const OpenDevice&) = delete;

    const std::string& serial() const { return serial_; }

    // For the modes of `settings`. Throws Error if the device's own is unusable.
    Calibration calibration(const Settings& settings) const;
    void start(const Settings& settings);

    // Waits at most `timeout`, in whole milliseconds, for the next capture.
    WaitResult wait(Duration timeout, CapturePtr& capture) const;

    ImagePtr depth_of(const CapturePtr& capture) const;  // null: it has none
    ImagePtr color_of(const CapturePtr& capture) const;

    // Nothing if the image is not one of this size.
    std::optional<DepthPicture> depth_picture(const ImagePtr& image, Size size) const;
    std::optional<ByteView> jpeg_picture(const ImagePtr& image, Size size) const;

    // The device's own time of a picture, 0 if it has none.
    Duration device_time(const ImagePtr& image) const;
    std::uint64_t system_ns(const ImagePtr& image) const;

private:
    void open(const Settings& settings);
    void set_controls(const Settings& settings) const;

    Library library_;
    DevicePtr device_;
    std::string name_;
    std::string serial_;
    bool started_ = false;
};

}  // namespace theatron::capture::k4a
