// SPDX-License-Identifier: Apache-2.0
// Live devices: enumeration, opening, and pictures as checked views.
//
// Data from a device or its library is not trusted: sizes are compared with the requested mode
// before any byte is read.
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

// A device as listed by `theatron cameras`.
struct FoundDevice {
    std::uint32_t index = 0;
    std::string serial;
    std::string problem;  // one sentence if it cannot be opened, for example if it is in use
};
struct FoundDevices {
    std::vector<FoundDevice> devices;
    std::string problem;  // one sentence if the library is missing
};
// Opens each device briefly. Does not throw.
FoundDevices find_devices();

// A depth picture whose rows may be padded.
struct DepthPicture {
    const std::uint8_t* bytes = nullptr;
    std::size_t stride_bytes = 0;
};

// One opened device; the destructor stops and closes it.
class OpenDevice {
public:
    // Throws Error with a remedy if the device is missing, in use or not permitted.
    OpenDevice(const Library& library, const Settings& settings);
    ~OpenDevice();
    OpenDevice(const OpenDevice&) = delete;
    OpenDevice& operator=(const OpenDevice&) = delete;

    const std::string& serial() const { return serial_; }

    // The calibration for the modes of `settings`. Throws Error if the device's data is unusable.
    Calibration calibration(const Settings& settings) const;
    void start(const Settings& settings);

    // Waits at most `timeout`, in whole milliseconds, for the next capture.
    WaitResult wait(Duration timeout, CapturePtr& capture) const;

    ImagePtr depth_of(const CapturePtr& capture) const;  // null: no depth in it
    ImagePtr color_of(const CapturePtr& capture) const;

    // Nullopt if the image is not of this size.
    std::optional<DepthPicture> depth_picture(const ImagePtr& image, Size size) const;
    std::optional<ByteView> jpeg_picture(const ImagePtr& image, Size size) const;

    // The device's own time of a picture; 0 if it has none.
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
