// SPDX-License-Identifier: Apache-2.0
// Finds a patient's names and numbers in texts that everybody sees. Files are often named after
// patients, and parts after files.
#pragma once

#include <string>
#include <vector>

#include "cases/dicom_slice.h"

namespace theatron::cases {

class PatientWords {
public:
    // Takes names, numbers, addresses and the date of birth; other identifiers are ignored.
    void add(const Identifier& identifier);

    // True if one of them occurs in `text` (UTF-8), also with other capitals, accents, umlauts
    // written as two letters, other separators, or joined to another word. Names of three letters
    // are found at the ends of words, shorter ones and short identifiers as whole words only; a
    // number of two or three digits not where a word such as "label" counts things. Usual words of
    // medicine ("liver") never count as a name that is a part of them. The date of birth is found
    // in all usual orders, with two or four digits of the year and with names of months. Single
    // letters and digits are not looked for.
    bool occur_in(const std::string& text) const;

private:
    struct Date {
        int year = 0, month = 0, day = 0;
    };
    // All words are folded: small basic letters and digits.
    std::vector<std::string> names_;          // found anywhere
    std::vector<std::string> at_ends_;        // of words
    std::vector<std::string> whole_;          // words
    std::vector<std::string> numbers_;        // found anywhere
    std::vector<std::string> short_numbers_;  // of whole words, which may be several
    std::vector<Date> born_;

    void add_name(const std::string& text);
    void add_identifier(const std::string& text);
    void add_birth_date(const std::string& value);
    bool is_harmless(const std::string& word) const;
    bool has_name(const std::vector<std::string>& words) const;
};

}  // namespace theatron::cases
