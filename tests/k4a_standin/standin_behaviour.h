// SPDX-License-Identifier: Apache-2.0
// How the stand-in for libk4a behaves, from $K4A_STANDIN: words and key=number
// pairs separated by commas, read when the library is asked for devices.
#pragma once

#include <map>
#include <string>

namespace standin {

class Behaviour {
public:
    static Behaviour from_environment();

    // What is known:
    //   devices=1           how many are plugged in
    //   refuse_open, refuse_start, refuse_controls
    //   calibration=none|garbage|long|FILE
    //   unplug_after=N      from frame N on, waiting fails
    //   stall_after=N       from frame N on, nothing comes
    //   no_color            captures without colour
    //   no_depth            captures without depth
    //   skip_color=N        frame N has no colour
    //   apart               colour comes in a capture of its own, after the depth
    //   color_first         the same, before the depth
    //   depth_width=N, depth_stride=N, depth_bytes=N, depth_format=N   lies about depth
    //   color_bytes=N, color_format=N, not_jpeg                        lies about colour
    //   color_later_us=N    colour is dated so much after its depth
    //   padding=N           bytes after each row of depth
    //   clock=steady|wall|none   what the system time stamps count
    //   device_clock=none   no device time stamps
    //   period_us=N         real time from frame to frame (device time goes by the frame rate)
    bool has(const std::string& word) const { return words_.count(word) > 0; }
    std::string text(const std::string& key, const std::string& otherwise) const;
    long number(const std::string& key, long otherwise) const;

private:
    std::map<std::string, std::string> words_;
};

}  // namespace standin
