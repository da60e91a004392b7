// SPDX-License-Identifier: Apache-2.0
// Films with a known delay, drawn pixel by pixel: what tells how wrong a measured delay is.
//
// A screen in the scene shows a strip. A camera takes pictures of it, and a display shows each of
// them a fixed time after the middle of its exposure, at the display's next refresh. The film shows
// the scene's screen on the left and the display on the right, both at a slant. The clocks of
// screen, camera, display and film begin at random and are independent of each other.
#pragma once

#include <random>
#include <vector>

#include "photon/grey.h"
#include "photon/strip.h"

namespace theatron::photon {

struct SimulatedSetup {
    double delay_ms = 100;  // from the middle of a picture's exposure until the display has it
    double film_fps = 240;
    double film_speed = 1;  // the film's own clock, to real time: 0.125 for a slow motion of 8
    double exposure_share = 0.5;  // of the film's frame time, at most 8 ms
    double readout_share = 0.6;   // the last row is exposed this share of it after the first
    double screen_hz = 59.95, display_hz = 60.02;
    double camera_fps = 30.03, camera_exposure_ms = 5;
    double blur_px = 1.0;  // standard deviation
    double noise = 6;      // standard deviation, of 255
    double slant = 1;      // 0: seen from in front
    double seconds = 4;
    Size size{640, 360};
    unsigned seed = 1;
};

class SimulatedFilm {
public:
    explicit SimulatedFilm(const SimulatedSetup& setup);

    int frames() const { return int(setup_.seconds * setup_.film_fps); }
    // The time of a frame by the film's own clock, as in a video file.
    double film_time_ms(int frame) const;
    void draw(int frame, GreyImage& out) const;

    // The mean time from when the screen began to show a value until the display did, over all
    // pictures of the camera that the film shows: what a measurement should say.
    double true_motion_to_photon_ms() const;

private:
    // A strip as it is seen for a while: each time by its share of the light.
    struct Mixture {
        struct Part {
            StripTime time;
            double share;
        };
        std::vector<Part> parts;
    };
    // A screen's refreshes, or a camera's pictures: the n-th is at `first + n * period`.
    struct Beat {
        double first_ms, period_ms;
        long number_at(double ms) const;
        double time_of(long number) const { return first_ms + double(number) * period_ms; }
    };

    double frame_begin_ms(int frame) const;
    double taken_ms(long picture) const;  // the middle of the exposure
    double shown_ms(long picture) const;  // by the display
    long picture_shown_at(double ms) const;
    Mixture scene_between(double from_ms, double to_ms) const;
    Mixture display_between(double from_ms, double to_ms) const;
    void draw_one(int frame, bool is_display, GreyImage& out) const;

    SimulatedSetup setup_;
    Beat screen_{}, display_{}, camera_{}, film_{};
};

}  // namespace theatron::photon
