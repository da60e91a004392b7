// SPDX-License-Identifier: Apache-2.0
#include "cases/same_patient.h"

#include <utility>

#include "cases/folded_text.h"

namespace theatron::cases {
namespace {

std::string value_of(const std::vector<Identifier>& identifiers, const char* name) {
    for (const Identifier& identifier : identifiers)
        if (identifier.name == name)
            return identifier.value;
    return "";
}

// The spellings of a name: in letters, in ideographs, by sound (DICOM PS3.5, 6.2.1).
std::vector<std::string> spellings_of(const std::string& name) {
    std::vector<std::string> spellings(1);
    for (const char c : name)
        if (c == '=')
            spellings.emplace_back();
        else
            spellings.back() += c;
    return spellings;
}

bool may_be_one_name(const std::string& a, const std::string& b) {
    if (a.empty() || b.empty())
        return true;
    for (const std::string& one : spellings_of(a))
        for (const std::string& other : spellings_of(b))
            if (!one.empty() && !other.empty() && is_same_name(one, other))
                return true;
    return false;
}

// The parts of a number stay apart: 1-11 is not 11-1.
std::vector<std::string> words_of_number(const std::string& number) {
    return folded_words(number, Umlaut::as_one_letter, Split::at_separators);
}

}  // namespace

bool may_be_one_patient(const std::vector<Identifier>& a, const std::vector<Identifier>& b) {
    const auto of_both = [&](const char* name) {
        return std::pair(value_of(a, name), value_of(b, name));
    };
    const auto [name_a, name_b] = of_both("PatientName");
    const auto [born_a, born_b] = of_both("PatientBirthDate");
    const bool may_be_name = may_be_one_name(name_a, name_b);
    const bool is_date_known = !born_a.empty() && !born_b.empty();
    const bool may_be_date = !is_date_known || born_a == born_b;
    const auto [number_a, number_b] = of_both("PatientID");
    if (number_a.empty() || number_b.empty())
        return may_be_name && may_be_date;
    // Hospitals use the same numbers, and some give one ("ANON") to all. A person may take another
    // name, or one of two dates may be written wrongly: the other of both then has to agree.
    if (words_of_number(number_a) != words_of_number(number_b))
        return false;
    return may_be_name ? may_be_date || !(name_a.empty() || name_b.empty())
                       : is_date_known && may_be_date;
}

}  // namespace theatron::cases
