// SPDX-License-Identifier: Apache-2.0
// The part of the k4a C interface that we use, in our own declarations: Microsoft's libk4a 1.4
// and Orbbec's library of the same name.
//
// Numbers, layouts and signatures are facts of that interface (k4a/k4a.h and k4a/k4atypes.h of
// release 1.4.1). Nothing is linked: k4a_library.h loads the library.
#pragma once

#include <cstddef>
#include <cstdint>

namespace theatron::capture::k4a {

// Handles: each is released with the function that names it.
struct DeviceObject;
struct CaptureObject;
struct ImageObject;

enum class Outcome : int { succeeded, failed };
enum class BufferResult : int { succeeded, failed, too_small };
enum class WaitResult : int { succeeded, failed, timeout };

enum class ImageFormat : int { mjpg = 0, depth16 = 4 };
enum class ColorResolution : int { off, p720, p1080, p1440, p1536, p2160, p3072 };
enum class DepthMode : int { off, nfov_2x2, nfov, wfov_2x2, wfov };
enum class FrameRate : int { fps5, fps15, fps30 };
enum class SyncRole : int { standalone, master, subordinate };
enum class ColorControl : int { exposure_us = 0, white_balance_kelvin = 6, powerline = 9 };
enum class ControlMode : int { automatic, manual };

struct Configuration {
    ImageFormat color_format = ImageFormat::mjpg;
    ColorResolution color = ColorResolution::off;
    DepthMode depth = DepthMode::off;
    FrameRate frame_rate = FrameRate::fps30;
    bool synchronized_only = false;  // deliver captures with both pictures only
    std::int32_t depth_delay_off_color_us = 0;
    SyncRole sync = SyncRole::standalone;
    std::uint32_t delay_off_master_us = 0;  // for subordinates only
    bool no_indicator_light = false;
};
static_assert(offsetof(Configuration, synchronized_only) == 16);
static_assert(offsetof(Configuration, depth_delay_off_color_us) == 20);
static_assert(offsetof(Configuration, delay_off_master_us) == 28);
static_assert(sizeof(Configuration) == 36);

// All functions used: result type, name without "k4a_", arguments.
#define THEATRON_K4A_FUNCTIONS(USE)                                                          \
    USE(std::uint32_t, device_get_installed_count, (void))                                   \
    USE(Outcome, device_open, (std::uint32_t index, DeviceObject * *device))                 \
    USE(void, device_close, (DeviceObject * device))                                         \
    USE(BufferResult, device_get_serialnum,                                                  \
        (DeviceObject * device, char* text, std::size_t* size))                              \
    USE(BufferResult, device_get_raw_calibration,                                            \
        (DeviceObject * device, std::uint8_t * bytes, std::size_t * size))                   \
    USE(Outcome, device_set_color_control,                                                   \
        (DeviceObject * device, ColorControl control, ControlMode mode, std::int32_t value)) \
    USE(Outcome, device_start_cameras,                                                       \
        (DeviceObject * device, const Configuration* configuration))                         \
    USE(void, device_stop_cameras, (DeviceObject * device))                                  \
    USE(WaitResult, device_get_capture,                                                      \
        (DeviceObject * device, CaptureObject * *capture, std::int32_t ms))                  \
    USE(void, capture_release, (CaptureObject * capture))                                    \
    USE(ImageObject*, capture_get_depth_image, (CaptureObject * capture))                    \
    USE(ImageObject*, capture_get_color_image, (CaptureObject * capture))                    \
    USE(std::uint8_t*, image_get_buffer, (ImageObject * image))                              \
    USE(std::size_t, image_get_size, (ImageObject * image))                                  \
    USE(ImageFormat, image_get_format, (ImageObject * image))                                \
    USE(int, image_get_width_pixels, (ImageObject * image))                                  \
    USE(int, image_get_height_pixels, (ImageObject * image))                                 \
    USE(int, image_get_stride_bytes, (ImageObject * image))                                  \
    USE(std::uint64_t, image_get_device_timestamp_usec, (ImageObject * image))               \
    USE(std::uint64_t, image_get_system_timestamp_nsec, (ImageObject * image))               \
    USE(void, image_release, (ImageObject * image))

}  // namespace theatron::capture::k4a
