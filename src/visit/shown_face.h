// SPDX-License-Identifier: Apache-2.0
// A person's own face, from their sealed file to the bytes that go into a session.
#pragma once

#include <memory>
#include <string>

#include "base/bytes.h"
#include "face/enrolled_face.h"

namespace theatron::visit {

// The bytes that client::Participant::show_own_face() takes: fewer vertices, and textures with
// fewer bytes, where the face has more than a session takes. A second or two for a head of 25 000
// vertices, some 20 ms for the generated one. Throws Error where the face is damaged; `file` is
// named then.
Bytes shown_face(const face::EnrolledFace& face, const std::string& file);

}  // namespace theatron::visit
