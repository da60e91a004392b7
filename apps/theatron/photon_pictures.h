// SPDX-License-Identifier: Apache-2.0
// Live pictures in which `theatron photon read` looks for a strip.
#pragma once

#include <memory>

#include "image/frame.h"
#include "image/image.h"
#include "photon_read.h"

namespace theatron::app {

class PhotonPictures {
public:
    virtual ~PhotonPictures() = default;
    // The next picture, valid until the next call; null if none came within 100 ms. Throws Error
    // with one sentence when no more can come.
    virtual const ColorImage* next() = 0;
    // The points in time of the last picture's frame, in session time; null where they are not
    // known, as for a camera.
    virtual const FrameTimes* times() const { return nullptr; }
};

// The view of a participant of a session, drawn anew with each frame that arrives. Throws Error
// for a wrong link, view or renderer.
std::unique_ptr<PhotonPictures> session_pictures(const PhotonRead& wanted);
// The colour pictures of a camera. Throws Error if it cannot be opened.
std::unique_ptr<PhotonPictures> camera_pictures(const std::string& camera);

}  // namespace theatron::app
