// SPDX-License-Identifier: Apache-2.0
// The behaviour of the stand-in for libk4a, from $K4A_STANDIN: flags and key=number pairs,
// separated by commas, parsed when devices are enumerated or opened.
#pragma once

#include <map>
#include <string>

namespace standin {

class Behaviour {
public:
    static Behaviour from_environment();

    // Flags and keys:
    //   devices=1           number of devices
    //   refuse_open, refuse_start, refuse_controls
    //   calibration=none|garbage|long|FILE
    //   unplug_after=N      from frame N on, waiting fails
    //   in_vain=N           before each capture, N waits end at once without one
    //   stall_after=N       from frame N on, no captures come
    //   no_color            captures without colour
    //   no_depth            captures without depth
    //   skip_color=N        frame N has no colour
    //   apart               colour comes in a separate capture after the depth
    //   color_first         the same, before the depth
    //   depth_width=N, depth_stride=N, depth_bytes=N, depth_format=N   false values for depth
    //   color_bytes=N, color_format=N, not_jpeg                        false values for colour
    //   color_later_us=N    time stamp of colour, relative to its depth
    //   padding=N           bytes after each row of depth
    //   clock=steady|wall|none   clock of the system time stamps
    //   device_clock=none   no device time stamps
    //   period_us=N         real time between frames (device time follows the frame rate)
    bool has(const std::string& word) const { return words_.count(word) > 0; }
    std::string text(const std::string& key, const std::string& otherwise) const;
    long number(const std::string& key, long otherwise) const;

private:
    std::map<std::string, std::string> words_;
};

}  // namespace standin
