// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <string_view>

#include "codec/strata_tables.h"

namespace theatron::codec::strata {
namespace {

// Means over frames of time-of-flight, stereo and structured-light sensors.
// One line per context, one letter per token: "." is level 0, "a" is 1, and so on.
constexpr std::string_view lines[coded_contexts] = {
    "a..vqpkjiiihihhghggfgfgefeejifebaaa................",
    "a..ultjmijiihihigighfhfgfgekkhgdcaa................",
    "f..tookljkjkjjijijijijhjhjhnonnllihca..............",
    "a..vqpjhdcaaaaaa.......a...a....a..................",
    "a..umtgmbhacaaaa.aaa.aaa.a.aa...a..................",
    "f..vpqjkdhadce.dab.bad.d.dagighgjafb...............",
    "a..vrpjiecaaaaaa.aaaaaaa...aa...a..................",
    "a..ultfmbhadabaaaaaaaa.a.a.aa...a..................",
    "e..vpqkkfhdfcfbbacacac.b.d.fhgggiaeb...............",
    "a..vrpkjgfddbbaaaaaaaaaaaaaaa...a..................",
    "a..umthoejcgadacaaaaaaaaaaaaaa..a..................",
    "e..uqqlmhkfiegdgbfafaeadadagiggfiaeb...............",
    "b..urqnmkjhhffedccabaaaaaaabaaa....................",
    "c..tntkqimgjehcgafadacabaaacaa..a..................",
    "f..upqmoknilhkfjeidhdhbgagaiiecdfacaa..............",
    "d..upponmmlkjjiihgggfeeeddcgfaa.a..................",
    "e..toqmqlpjnilhkfjeidhdfbfahfaa....................",
    "g..unomnkojoinhmgkfkfjdjdiclkgcaaaaaa..............",
    "e..uonnnmmllllkkkjjjjiiihhglkebaaa.................",
    "f..unomnlnlnkmjlikhkhjgjgiflkeaaaaa................",
    "h..umnlmkmjnjnimhmhlgkfkfjennjgaaaaaaaa............",
    "e..uonlllllkkkkkkkjjjjjjjjinmjgaaaaa.a.............",
    "e..unolmllklkkjkjkjkijhjhjhnmifaaaaaaaa............",
    "g..ummkljkjkjkikikhkhkgkfjgnomkefaaaaaaa...........",
    "e..uonkjjjhkijjjjjiihjhihhjnnkjhfeeb.a.............",
    "d..vnokljkjjijiiijihgihhgigmnkjebaaaaaa............",
    "e..unnjkijijiihihigigigififmnllllffeebdaa.a........",
    "f..uppkkeicfegedbgefdegbdcekljlklllklikdhe.........",
    "a..uoqloikikiiihegfhgfefeghklijjjhjiifjgda.........",
    "j..tonkkijijhihhghggggggfgglmllknlnlmlmkkgeaaaa.af.",
    "w..aaaaaaaaaaaaa.aaa..aa...aaaaaaaaaaaaaa.aa..aaaa.",
    "w..fegadabae.d.e.caabaaa.aaggddhiecefgfdcb...aceef.",
    "v..nlmijdgefbbdaacabbaacacbgfedcbcccddccfca......a.",
    "w..khjehcfbeadccaaaaacaaaaaeedefhfgefeeegbaaaaaabb.",
    "w..gefcebdadababaaaaaaaaaaaddccdhddbadbaaaaaaaaacd.",
    "v..jhiegcfbgbeafdgafbdccae.kihejmigchigefaaaeddffg.",
    "v..ommkliiggefeaecadaf.b.dahfbeahfgbagcffbbbdab.fd.",
    "v..nmmjkgifgefdgdfbfceadbeajighhlihfjiliiefabbbegg.",
    "v..qmmihffeebcccbcaabbbaaaaegfhfhggffcedeacefefdge.",
    "u..snnkjghcicg.e.c..ehceec.ihjeecgicfghehch..ei.hf.",
    "s..tpqkmijghffeeefeccdba.c.hfcfabcgfgfgfgccdfgccff.",
    "q..tpqlmjjiihhgggfffefefeedjjijijhhggdgeeccacbcace.",
    "v..pllhhfeddccbbbaabaaaaaaadedecedebdcdddcbaddefgf.",
    "u..rooklhfhiifdfgedfchdecachhhffgfdffhgfgdffjfiehi.",
    "t..spplmjjfhfgegeeecccabbcaggeecfeffgfgffefcfffegi.",
    "s..sppmmjkiihhggfgefeedededijijijhifgfhggdedfefdfg.",
    "w..nklgiegddadacbaacaaaaaa.ddcecdcdcdaebdadbccddgf.",
    "v..plmijgihgdfbibgbe.h.f.edhhfifhed.feiigehd..gjhk.",
    "t..spqlnhkhifhegdgdfbdcdacbggfeegfgfhdfeefgbffeffh.",
    "t..roplnikhjgifhdhdgdgdfcfcijijijhighgihhgheeegegg.",
    "t..tnohjfhdgeedeccbbbbbaaaafddgfgfgghgjiifdadcdggi.",
    "t..toojjhjfj.g.h.g.e...f.c.ffhgee.ggjglgied.egehik.",
    "o..upqlmijhhgggfeedddccbcaaffdeeffgehghffaa..a..ag.",
    "o..upqlmjkhjgifhegefeeddddciihihihihjikjigdaaaa.ag.",
    "r..uoqikfhegdecfbcbdccbcacagihihhhigiijiifdbbceggg.",
    "s..uopilgjfiehchbgbecdceadahiggeffhhhijhhde.badghh.",
    "l..upqkmgjfhdgcfbebdabababafgefdffhhihjihdba.a..ag.",
};

Levels read_lines() {
    Levels levels{};
    for (unsigned c = 0; c < coded_contexts; ++c) {
        std::transform(lines[c].begin(), lines[c].end(), levels[c].begin(), [](char letter) {
            return letter == '.' ? std::uint8_t(0) : std::uint8_t(letter - 'a' + 1);
        });
    }
    return levels;
}

}  // namespace

const Levels& standard_levels() {
    static const Levels levels = read_lines();
    return levels;
}

}  // namespace theatron::codec::strata
