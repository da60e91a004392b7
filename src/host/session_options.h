// SPDX-License-Identifier: Apache-2.0
// The options of one session of a host: its cameras, people and links.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/time.h"
#include "session/past.h"
#include "wire/role.h"

namespace theatron::host {

struct SessionOptions {
    std::vector<std::string> cameras;  // specifications; none: people meet without cameras
    std::filesystem::path places;      // docs/formats/places.md; empty: none
    std::vector<std::string> filters;  // filter_choice.h
    std::string name = "operating room";
    std::string token;            // of experts; empty: from the state folder
    Duration link_lifetime{};     // the roles' links become invalid after it; 0: never
    bool asks = false;            // experts and observers wait until an operator admits them
    std::filesystem::path state;  // keys, tokens and links; empty: the user's state folder
    std::filesystem::path cases;  // the folder of cases that are offered; empty: none
    // The folder of recordings that operators begin (recording_program.h); empty: recordings in
    // the host's state folder.
    std::filesystem::path recordings;
    // The roles that are told who the patient of the open case is; never observers.
    std::vector<wire::Role> patient_for = {wire::Role::operator_};
    // How far participants may look back, at most session::Past::longest_reach; 0: nothing is kept.
    Duration look_back = session::Past::longest_reach;
};

}  // namespace theatron::host
