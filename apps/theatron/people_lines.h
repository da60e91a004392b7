// SPDX-License-Identifier: Apache-2.0
// Decisions on people, one per line of standard input, for operators (`theatron join`) and for the
// person at the host's machine (`theatron host`).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "client/participant.h"
#include "host/host.h"
#include "wire/control.h"

namespace theatron::app {

// One of the people to decide on.
struct SomePerson {
    ParticipantId id{};
    std::string name;
    bool waits = false;  // for admission
    Bytes person;        // as in wire::Visitor; empty: not known
    bool records = false;
};

struct PersonDecision {
    wire::ManageAction action{};
    ParticipantId person{};
    wire::Role role{};
};

// A text for the user that lists the commands.
const char* people_help();

// Reads a line: "admit WHO", "refuse WHO", "mute WHO", "unmute WHO", "role WHO ROLE",
// "remove WHO", "revoke WHO" or "end session". WHO is a name or "#" and a number. nullopt if it is
// none of these. Throws Error with one sentence if the line is wrong, or if none or more than one
// of `people` fits.
std::optional<PersonDecision> parse_people_line(const std::string& line,
                                                const std::vector<SomePerson>& people);

// Carries out such a line; false if it is none. A sentence on a wrong line is printed.
bool obey_people_line(client::Participant& participant, const std::string& line);
bool obey_people_line(host::Host& host, const std::string& line);

// Prints refusals of decisions.
void print_managed(client::Participant& participant);

}  // namespace theatron::app
