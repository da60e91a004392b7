// SPDX-License-Identifier: Apache-2.0
// The rules for cameras that a participant offers to a session. Pure functions.
#pragma once

#include <cstddef>
#include <vector>

#include "base/ids.h"
#include "geometry/calibration.h"
#include "session/admission.h"
#include "session/session_cameras.h"
#include "wire/control.h"

namespace theatron::session {

// Cameras of one publisher at once.
inline constexpr std::size_t max_published = 8;

// The cameras of an offer, which have no numbers yet.
std::vector<wire::Camera> cameras_of(const wire::Publish& offer, wire::SessionId session);

// The reason why cameras that the participant `id` offers cannot join the session; empty if they
// can.
wire::Text problem_of_offer(ParticipantId id, const Admission::Participant& publisher,
                            const SessionCameras& present,
                            const std::vector<wire::Camera>& cameras);

// Bytes of the largest media message of such a camera.
std::size_t max_media_size(const Calibration& calibration);

}  // namespace theatron::session
