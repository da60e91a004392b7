// SPDX-License-Identifier: Apache-2.0
#include "headset_input.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace theatron::web {
namespace {

constexpr double most_eyes = 4;

class Numbers {
public:
    explicit Numbers(ByteView bytes) : rest_(bytes) {}

    double next() {
        float number = 0;
        if (rest_.size() < sizeof(number)) {
            fits_ = false;
            return 0;
        }
        std::memcpy(&number, rest_.data(), sizeof(number));
        rest_ = rest_.subspan(sizeof(number));
        fits_ = fits_ && std::isfinite(number);
        return fits_ ? double(number) : 0;
    }
    Vec3 place() {
        const double x = next(), y = next();
        return {x, y, next()};
    }
    Pose pose() {
        Pose pose;
        pose.translation = place();
        const double x = next(), y = next(), z = next(), w = next();
        if (x * x + y * y + z * z + w * w > 0)
            pose.rotation = normalized(Quat{w, x, y, z});
        return pose;
    }
    bool fit() const { return fits_ && rest_.empty(); }

private:
    ByteView rest_;
    bool fits_ = true;
};

xr::HeadsetEye read_eye(Numbers& in) {
    xr::HeadsetEye eye;
    eye.x = int(in.next());
    eye.y = int(in.next());
    eye.size.width = int(in.next());
    eye.size.height = int(in.next());
    const double width = in.next(), height = in.next(), aside = in.next(), above = in.next();
    if (width > 0 && height > 0) {
        eye.left = (aside - 1) / width;
        eye.right = (aside + 1) / width;
        eye.top = -(above + 1) / height;
        eye.bottom = (1 - above) / height;
    }
    eye.floor_from_eye = in.pose();
    return eye;
}

std::optional<xr::HandState> read_hand(Numbers& in) {
    const double kind = in.next();
    if (kind == 0)
        return std::nullopt;
    xr::HandState hand;
    hand.floor_from_aim = in.pose();
    hand.floor_from_grip = in.pose();
    hand.trigger = in.next();
    hand.squeeze = in.next();
    hand.stick.x = in.next();
    hand.stick.y = -in.next();
    hand.lower_button = in.next() != 0;
    hand.upper_button = in.next() != 0;
    if (kind == 2) {
        xr::HandJoints joints;
        joints.wrist = in.place();
        joints.thumb_tip = in.place();
        joints.index_tip = in.place();
        joints.middle_tip = in.place();
        joints.ring_tip = in.place();
        hand.joints = joints;
    }
    return hand;
}

}  // namespace

std::optional<xr::HeadsetFrame> read_headset_frame(ByteView bytes) {
    Numbers in(bytes);
    xr::HeadsetFrame frame;
    frame.until_shown = seconds_to_duration(std::clamp(in.next(), 0.0, 1000.0) / 1000);
    frame.floor_from_head = in.pose();
    const double eyes = in.next();
    if (!(eyes >= 1 && eyes <= most_eyes))
        return std::nullopt;
    for (int i = 0; i < int(eyes); ++i)
        frame.eyes.push_back(read_eye(in));
    for (auto& hand : frame.hands)
        hand = read_hand(in);
    return in.fit() ? std::optional(frame) : std::nullopt;
}

std::optional<Pose> read_headset_pose(ByteView bytes) {
    Numbers in(bytes);
    const Pose pose = in.pose();
    return in.fit() ? std::optional(pose) : std::nullopt;
}

}  // namespace theatron::web
