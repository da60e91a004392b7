// SPDX-License-Identifier: Apache-2.0
// Knows when the GPU has finished a picture. A page has one picture at a time.
#pragma once

namespace theatron::web {

// For the page's one thread, with the context of GL current. Only one may live at a time.
class PictureFence {
public:
    PictureFence() = default;
    ~PictureFence() { drop(); }
    PictureFence(const PictureFence&) = delete;
    PictureFence& operator=(const PictureFence&) = delete;

    // Behind all that was drawn so far.
    void begin();
    bool is_waiting() const { return waits_; }
    // True once after begin(), when the GPU has come there. Never waits.
    bool take_passed();

private:
    void drop();

    bool waits_ = false;
};

}  // namespace theatron::web
