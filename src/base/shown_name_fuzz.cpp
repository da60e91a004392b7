// SPDX-License-Identifier: Apache-2.0
// Any bytes: the name is unchanged by a second pass, has no more characters than allowed, looks
// like itself, and is told apart from itself; that of a person has no role, comma or number
// sign.
#include <cstdint>
#include <cstdlib>

#include "base/outside_text.h"
#include "base/shown_name.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    constexpr std::size_t limit = 64;
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    const std::string name = theatron::clean_name(text, limit);
    const std::string look = theatron::look_of(name);
    const std::string other = theatron::told_apart(name, {name}, limit);
    const std::vector<std::string> facts{"operator"};
    const std::string person = theatron::person_name(text, facts, limit);
    if (theatron::person_name(person, facts, limit) != person ||
        theatron::clean_name(person, limit) != person ||
        person.find_first_of(",#") != person.npos || person.find("(operator)") != person.npos)
        std::abort();
    if (theatron::clean_name(name, limit) != name || theatron::clean_text(name, limit) != name ||
        theatron::clean_text(look, look.size()) != look || theatron::look_of(other) == look ||
        theatron::clean_text(other, limit) != other)
        std::abort();
    return 0;
}
