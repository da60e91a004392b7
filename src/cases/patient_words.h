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
    // Takes names, numbers and the date of birth; other identifiers are ignored.
    void add(const Identifier& identifier);

    // True if one of them occurs in `text` (UTF-8), also with other capitals, accents, umlauts
    // written as two letters, other separators, or joined to another word. Names of two letters
    // count as whole words only; shorter ones and short numbers are not looked for.
    bool occur_in(const std::string& text) const;

private:
    std::vector<std::string> words_;        // folded; found anywhere
    std::vector<std::string> short_words_;  // folded; found as whole words
    void add_word(std::string word, bool is_name);
    void add_text(const std::string& text, bool is_name);
};

}  // namespace theatron::cases
