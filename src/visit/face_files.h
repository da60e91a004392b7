// SPDX-License-Identifier: Apache-2.0
// Files and ports of faces that commands share.
#pragma once

#include <string>

#include "face/enrolled_face.h"
#include "face/network.h"
#include "face/recording.h"

namespace theatron::visit {

struct FacePort {
    std::string address = "127.0.0.1";
    int port = 9001;
};

// Throw Error with a sentence that repeats nothing of the file's content.
face::Recording read_face_recording(const std::string& file);
face::Network read_face_network(const std::string& file);
face::Source face_source(const std::string& name);
// The generated head if `file` is empty.
face::MorphModel read_face_model(const std::string& file);

// A person's own face, sealed with a passphrase. Reading takes some tenths of a second.
Bytes sealed_face(const face::EnrolledFace& face, const std::string& passphrase);
face::EnrolledFace read_own_face(const std::string& file, const std::string& passphrase);
// Throws Error unless the file begins as one.
void require_own_face(const std::string& file);

// The passphrase in the first line of a file that only its owner may read, or, without a file, from
// the terminal, which does not show it. `is_new`: asked for twice, and at least eight bytes long.
std::string face_passphrase(const std::string& file, bool is_new);

}  // namespace theatron::visit
