#include "rhombicColour.h"
#include "rhombicLabelTable.h"
#include "rhombicLabelTableFormats.h"
#include "rhombicScanTest.h"

#include <cstdlib>
#include <cstring>
#include <ctime>
#include <fstream>
#include <random>
#include <set>

#include <sys/stat.h>

namespace fs = std::filesystem;

namespace
{

using rhombic::AnatomicalColour;
using rhombic::Failure;
using rhombic::FailureKind;
using rhombic::FindLabelTable;
using rhombic::Label;
using rhombic::LabelTable;
using rhombic::ParseLabelTable;
using Colour = std::array<std::uint8_t, 3>;

class LabelTableFile : public ScanTest
{
protected:
  fs::path
  Write(const std::string & name, const std::string & text) const
  {
    std::ofstream(m_Folder / name, std::ios::binary) << text;
    return m_Folder / name;
  }
};

const std::string ITKSNAP = "################################################\n"
                            "# ITK-SnAP Label Description File\n"
                            "# File format:\n"
                            "# IDX   -R-  -G-  -B-  -A--  VIS MSH  LABEL\n"
                            "################################################\n"
                            "    0     0    0    0        0  0  0    \"Clear Label\"\n"
                            "    5   204   10    7     0.25  1  1    \"left kidney, whole\"\n"
                            "    2     0  255    0        1  1  0    \"in slices only\"\n";

const std::string SlicerText = "# Color table file /tmp/a.ctbl\n"
                               "# 3 values\n"
                               "0 Background 0 0 0 0\n"
                               "1 left_kidney 185 102 83 255\n"
                               "7 part of liver 221 130 101 51\n";

const std::string SlicerCSV = "LabelValue,Name,Color_R,Color_G,Color_B,Color_A,Category_CodingScheme\n"
                              "1,left_kidney,185,102,83,255,SCT\n"
                              "5,\"mass, \"\"right\"\" kidney\",144,238,144,51,SCT\n"
                              "6,liver,,,,,\n";

const std::string FreeSurfer = "#$Id: some table $\n"
                               "\n"
                               "#No. Label Name:                            R   G   B   A\n"
                               "0   Unknown                                 0   0   0   0\n"
                               "4   Left-Ventricle                          120 18  134 0\n"
                               "130 Air                                     147 19  173 255\n";

const std::string BIDS = "index\tname\tabbreviation\tcolor\tmapping\n"
                         "1\tGray Matter\tGM\t#ff53bb\t1\n"
                         "2\tliver\tL\tn/a\t2\n";

/** The sentence that refuses a text; empty when it is not refused. */
std::string
Refusal(const std::string & text, const std::string & source = "t.txt")
{
  try
  {
    ParseLabelTable(text, source);
  }
  catch (const Failure & failure)
  {
    EXPECT_EQ(failure.GetKind(), FailureKind::Unreadable);
    const std::string sentence = failure.GetDescription();
    EXPECT_EQ(sentence.back(), '.') << sentence;
    EXPECT_EQ(sentence.find_first_of("\r\n\x1b"), std::string::npos) << sentence;
    return sentence;
  }
  return "";
}

void
ExpectRefusal(const std::string & text, const std::string & part)
{
  const std::string sentence = Refusal(text);
  EXPECT_NE(sentence.find(part), std::string::npos) << "of: " << text << "\nsaid: " << sentence;
}

std::string
Replaced(std::string text, const std::string & old, const std::string & by)
{
  for (std::size_t at = text.find(old); at != std::string::npos; at = text.find(old, at + by.size()))
  {
    text.replace(at, old.size(), by);
  }
  return text;
}

std::vector<std::int32_t>
Values(const LabelTable & table)
{
  std::vector<std::int32_t> values;
  for (const Label & label : table)
  {
    values.push_back(label.value);
  }
  return values;
}

TEST(LabelTable, ReadsITKSNAP)
{
  const LabelTable table = ParseLabelTable(ITKSNAP, "t.txt");
  ASSERT_EQ(Values(table), (std::vector<std::int32_t>{ 0, 2, 5 }));
  EXPECT_EQ(table[2].name, "left kidney, whole");
  EXPECT_EQ(table[2].colour, (Colour{ 204, 10, 7 }));
  EXPECT_EQ(table[2].opacity, 0.25);
  EXPECT_TRUE(table[2].isVisible);
  EXPECT_FALSE(table[1].isVisible);
  EXPECT_FALSE(table[0].isVisible);
}

TEST(LabelTable, ReadsITKSNAPWithoutComments)
{
  EXPECT_EQ(ParseLabelTable("1 2 3 4 1 1 1 \"a \"b\" c\"", "t")[0].name, "a \"b\" c");
}

TEST(LabelTable, ReadsSlicerText)
{
  const LabelTable table = ParseLabelTable(SlicerText, "t.txt");
  ASSERT_EQ(Values(table), (std::vector<std::int32_t>{ 0, 1, 7 }));
  EXPECT_EQ(table[1].name, "left_kidney");
  EXPECT_EQ(table[1].colour, (Colour{ 185, 102, 83 }));
  EXPECT_EQ(table[1].opacity, 1);
  EXPECT_TRUE(table[1].isVisible);
  EXPECT_EQ(table[2].name, "part of liver");
  EXPECT_EQ(table[2].opacity, 0.2);
  EXPECT_FALSE(table[0].isVisible);
}

TEST(LabelTable, ReadsSlicerCSV)
{
  const LabelTable table = ParseLabelTable(SlicerCSV, "t.csv");
  ASSERT_EQ(Values(table), (std::vector<std::int32_t>{ 1, 5, 6 }));
  EXPECT_EQ(table[0].colour, (Colour{ 185, 102, 83 }));
  EXPECT_EQ(table[1].name, "mass, \"right\" kidney");
  EXPECT_EQ(table[1].opacity, 0.2);
  EXPECT_EQ(table[2].colour, AnatomicalColour("liver", 6));
  EXPECT_EQ(table[2].opacity, 1);
}

TEST(LabelTable, ReadsFreeSurfer)
{
  const LabelTable table = ParseLabelTable(FreeSurfer, "t.txt");
  ASSERT_EQ(Values(table), (std::vector<std::int32_t>{ 0, 4, 130 }));
  EXPECT_EQ(table[1].name, "Left-Ventricle");
  EXPECT_EQ(table[1].colour, (Colour{ 120, 18, 134 }));
  EXPECT_EQ(table[1].opacity, 1);
  EXPECT_TRUE(table[1].isVisible);
  EXPECT_EQ(table[2].opacity, 0);
  EXPECT_FALSE(table[2].isVisible);
}

TEST(LabelTable, ReadsBIDS)
{
  const LabelTable table = ParseLabelTable(BIDS, "t.tsv");
  ASSERT_EQ(Values(table), (std::vector<std::int32_t>{ 1, 2 }));
  EXPECT_EQ(table[0].name, "Gray Matter");
  EXPECT_EQ(table[0].colour, (Colour{ 0xff, 0x53, 0xbb }));
  EXPECT_EQ(table[1].colour, AnatomicalColour("liver", 2));
}

TEST(LabelTable, AlphaOfATableWithoutCommentsIsTakenSoThatLabelsAreSeen)
{
  EXPECT_EQ(ParseLabelTable("1 a 1 2 3 0\n2 b 1 2 3 0\n", "t.txt")[0].opacity, 1);
  EXPECT_EQ(ParseLabelTable("0 a 1 2 3 0\n2 b 1 2 3 255\n", "t.txt")[1].opacity, 1);
  EXPECT_EQ(ParseLabelTable("1 a 1 2 3 0\n", "t.ctbl")[0].opacity, 0);
}

TEST(LabelTable, LineEndsMarksAndBlankLinesChangeNothing)
{
  for (const std::string & text : { ITKSNAP, SlicerText, SlicerCSV, FreeSurfer, BIDS })
  {
    const LabelTable plain = ParseLabelTable(text, "t.txt");
    for (const std::string & other : { Replaced(text, "\n", "\r\n"),
                                       Replaced(text, "\n", "\r"),
                                       "\xEF\xBB\xBF" + text,
                                       Replaced(text, "\n", "\n  \n\n"),
                                       text + "# end",
                                       text.substr(0, text.size() - 1) })
    {
      const LabelTable table = ParseLabelTable(other, "t.txt");
      ASSERT_EQ(Values(table), Values(plain)) << other;
      for (std::size_t n = 0; n < table.size(); ++n)
      {
        EXPECT_EQ(table[n].name, plain[n].name);
        EXPECT_EQ(table[n].colour, plain[n].colour);
        EXPECT_EQ(table[n].opacity, plain[n].opacity);
        EXPECT_EQ(table[n].isVisible, plain[n].isVisible);
      }
    }
  }
}

TEST(LabelTable, NamesLineAndFaultOfBadRows)
{
  ExpectRefusal(Replaced(ITKSNAP, "204", "256"), "t.txt, line 7: red is \"256\"");
  ExpectRefusal(Replaced(ITKSNAP, "0.25", "1.25"), "line 7: the opacity is \"1.25\"");
  ExpectRefusal(Replaced(ITKSNAP, "0.25", "nan"), "line 7: the opacity is \"nan\"");
  ExpectRefusal(Replaced(ITKSNAP, "  1  1  0  ", "  1  2  0  "), "line 8: the visibility is \"2\"");
  ExpectRefusal(Replaced(ITKSNAP, "whole\"", "whole"), "line 7");
  ExpectRefusal(Replaced(ITKSNAP, "    2  ", "    5  "), "line 8: value 5 is given twice, first in line 7");
  ExpectRefusal(Replaced(ITKSNAP, "    5  ", "    5.5"), "line 7: the label's value is \"5.5\"");
  ExpectRefusal(Replaced(SlicerText, "102", "-1"), "line 4: green is \"-1\"");
  ExpectRefusal(Replaced(SlicerText, " 83 255", " 83"), "line 4: it has 5 words");
  ExpectRefusal(Replaced(SlicerText, "7 part", "1 part"), "line 5: value 1 is given twice, first in line 4");
  ExpectRefusal(Replaced(SlicerText, "1 left", "99999999999 left"), "line 4: the label's value");
  ExpectRefusal(Replaced(SlicerCSV, "144", "1e2"), "line 3: red is \"1e2\"");
  ExpectRefusal(Replaced(SlicerCSV, "kidney\"", "kidney"), "line 3: a quoted text does not end");
  ExpectRefusal(Replaced(SlicerCSV, "6,liver", ",liver"), "line 4: the label's value is \"\"");
  ExpectRefusal(Replaced(SlicerCSV, ",SCT", ",SCT,x,y"), "line 2: it has 9 fields");
  ExpectRefusal(Replaced(SlicerCSV, "6,", "1,"), "line 4: value 1 is given twice, first in line 2");
  ExpectRefusal(Replaced(FreeSurfer, "173 255", "173 x"), "line 6: alpha is \"x\"");
  ExpectRefusal(Replaced(FreeSurfer, "130 ", "4   "), "line 6: value 4 is given twice, first in line 5");
  ExpectRefusal(Replaced(BIDS, "#ff53bb", "#ff53b"), "line 2: its colour is \"#ff53b\"");
  ExpectRefusal(Replaced(BIDS, "#ff53bb", "#ff5-bb"), "line 2: its colour");
  ExpectRefusal(Replaced(BIDS, "2\tliver", "1\tliver"), "line 3: value 1 is given twice, first in line 2");
  ExpectRefusal(Replaced(BIDS, "2\tliver", "\tliver"), "line 3: the label's value is \"\"");
  ExpectRefusal(Replaced(BIDS, "2\tliver\tL\tn/a", " \t\t\t#ff53bb"), "line 3: the label's value is \"\"");
  ExpectRefusal("1 a\x1b[31m\n b 1 2 3 \x1b\x01\n", "t.txt");
}

TEST(LabelTable, ReadsTablesOfOtherPrograms)
{
  for (const std::string & text :
       { std::string("index,name\n0,background\n1,liver\n12,\"kidney, left\"\n"),
         std::string("\xEF\xBB\xBFlabel;name\r\n0;background\r\n1;liver\r\n12;kidney, left\r\n"),
         std::string("Value\tName\n0\tbackground\n1\tliver\n12\tkidney, left\n"),
         std::string("name,value\nbackground,0\nliver,1\n\"kidney, left\",12\n"),
         std::string("0 background\n1 liver\n12 kidney, left\n"),
         std::string("\xEF\xBB\xBF"
                     "0\tbackground\r\n1\tliver\r\n12\t\"kidney, left\"\r\n"),
         std::string("{ \"channel_names\": { \"0\": \"CT\" },\n \"labels\": { \"background\": 0, "
                     "\"liver\": 1, \"kidney, left\": [12] } }"),
         std::string("\xEF\xBB\xBF{\"labels\":{\"0\":\"background\",\"12\":\"kidney, "
                     "left\",\"1\":\"liver\"}}") })
  {
    const LabelTable table = ParseLabelTable(text, "t.txt");
    ASSERT_EQ(table.size(), 3U) << text;
    EXPECT_EQ(table[1].value, 1);
    EXPECT_EQ(table[1].name, "liver") << text;
    EXPECT_EQ(table[1].colour, rhombic::AnatomicalColour("liver", 1));
    EXPECT_EQ(table[2].value, 12);
    EXPECT_EQ(table[2].name, "kidney, left") << text;
    EXPECT_TRUE(table[2].isVisible);
  }
  ExpectRefusal("{\"labels\": {\"background\": 0, \"whole tumour\": [1, 2], \"core\": 2}}",
                "\"whole tumour\" is a region of several values");
  ExpectRefusal("{\"labels\": [\"liver\"]}", "no object \"labels\"");
  ExpectRefusal("{\"labels\": {\"liver\": 1, \"spleen\": 1}}", "value 1 is given twice");
  ExpectRefusal("{\"labels\": {\"liver\": 1.5}}", "no whole number");
  ExpectRefusal("{\"labels\": {\"liver\"", "no object");
  ExpectRefusal(std::string("\xFF\xFE"
                            "1\0 \0l\0",
                            8),
                "UTF-16");
}

TEST(LabelTable, RefusesOtherTexts)
{
  for (const std::string & text : { std::string(),
                                    std::string("\n\n# nothing\n"),
                                    std::string("Dear colleague,\nthe liver is 7.\n"),
                                    std::string("a,b,c\n1,2,3\n"),
                                    std::string("1 2 3 4 5 6 7\n"),
                                    std::string("1 a 1 2 3 0\n\0", 13) })
  {
    ExpectRefusal(text, "it is no label table of ITK-SNAP, 3D Slicer, FreeSurfer, BIDS or nnU-Net");
  }
  ExpectRefusal("# Color procedural file a\n# 2 points\n0 0 0 0\n", "its colours are those of a scale");
}

TEST(LabelTable, RefusesAbsurdSizes)
{
  ExpectRefusal(SlicerText + std::string(1 << 20, ' '), "longer than 1 MiB");
  ExpectRefusal(SlicerText + std::string(100'000, '\n'), "more than 100,000 lines");
  EXPECT_EQ(ParseLabelTable(SlicerText + std::string(99'000, '\n'), "t").size(), 3U);
}

TEST(LabelTable, ShortRowsOfAWideTableCostLittle)
{
  std::string text = "LabelValue,Name" + std::string(500'000, ',') + "\n";
  std::size_t rows = 0;
  for (; text.size() < 1'000'000; ++rows)
  {
    text += std::to_string(rows) + ",a\n";
  }
  const std::clock_t start = std::clock();
  EXPECT_EQ(ParseLabelTable(text, "t.csv").size(), rows);
  EXPECT_LT(std::clock() - start, 20 * CLOCKS_PER_SEC); // minutes, if each row took as long as the header
}

TEST(LabelTable, ReadsAnyBytesOrRefusesThem)
{
  std::mt19937 random(20261121);
  const auto below = [&random](std::size_t limit) { return static_cast<std::size_t>(random()) % limit; };
  const std::string seeds[] = { ITKSNAP, SlicerText, SlicerCSV, FreeSurfer, BIDS };
  const std::string letters = "0123456789 \t\n\r\",#.-eaLR\xC3\xA9\xFF";
  for (int round = 0; round < 20'000; ++round)
  {
    std::string text = seeds[below(5)];
    for (std::size_t change = 0; change < 1 + below(8) && !text.empty(); ++change)
    {
      const std::size_t at = below(text.size());
      switch (below(4))
      {
        case 0:
          text[at] = static_cast<char>(below(256));
          break;
        case 1:
          text[at] = letters[below(letters.size())];
          break;
        case 2:
          text.erase(at, below(20));
          break;
        default:
          text.insert(at, text.substr(below(text.size()), below(40)));
      }
    }
    Refusal(text, round % 2 == 0 ? "t.ctbl" : "t.txt");
  }
  for (int round = 0; round < 2000; ++round)
  {
    std::string text(below(300), ' ');
    for (char & letter : text)
    {
      letter = static_cast<char>(below(256));
    }
    Refusal(text);
  }
}

TEST(LabelTable, NamesAreSafeToShow)
{
  EXPECT_EQ(rhombic::SanitizeLabelName(" left \t kidney\n", 1), "left kidney");
  EXPECT_EQ(rhombic::SanitizeLabelName("a\x1b[31mb\x7f", 1), "a[31mb");
  EXPECT_EQ(rhombic::SanitizeLabelName("\xC3\xA9\xC2\x85\xE2\x80\xAE\xEF\xBB\xBFx", 1), "\xC3\xA9x");
  EXPECT_EQ(rhombic::SanitizeLabelName("f\xF6tus\xC3", 1), "f?tus?");
  EXPECT_EQ(rhombic::SanitizeLabelName("\xED\xA0\x80\xC0\x80", 1), "?????");
  EXPECT_EQ(rhombic::SanitizeLabelName("\x01 \n", 12), "label 12");
  const std::string kilobyte = rhombic::SanitizeLabelName("x" + Replaced(std::string(600, '.'), ".", "\xC3\xA9"), 1);
  EXPECT_EQ(kilobyte.size(), 99U);
}

TEST(LabelTable, FileStemsAreSafe)
{
  EXPECT_EQ(rhombic::FileStemOf("kidney_left"), "kidney_left");
  EXPECT_EQ(rhombic::FileStemOf("Left kidney (whole)"), "Left_kidney_whole");
  EXPECT_EQ(rhombic::FileStemOf("../../etc/passwd"), "etc_passwd");
  EXPECT_EQ(rhombic::FileStemOf("-rf .."), "rf");
  EXPECT_EQ(rhombic::FileStemOf("..."), "label");
  EXPECT_EQ(rhombic::FileStemOf(""), "label");
  EXPECT_EQ(rhombic::FileStemOf("\xE8\x82\x9D"), "label");
  EXPECT_EQ(rhombic::FileStemOf("a\xE8\x82\x9D"
                                "b"),
            "a_b");
  EXPECT_EQ(rhombic::FileStemOf(std::string(300, 'a')).size(), 100U);
}

TEST_F(LabelTableFile, ReadsFilesAndSaysWhichAreMissing)
{
  EXPECT_EQ(rhombic::ReadLabelTable(this->Write("a.label", ITKSNAP)).size(), 3U);
  try
  {
    rhombic::ReadLabelTable(m_Folder / "none.ctbl");
    FAIL();
  }
  catch (const Failure & failure)
  {
    EXPECT_EQ(failure.GetKind(), FailureKind::NotFound);
  }
  EXPECT_THROW(rhombic::ReadLabelTable(m_Folder), Failure);
  EXPECT_THROW(rhombic::ReadLabelTable(this->Write("big.csv", std::string(3 << 20, 'a'))), Failure);
}

TEST_F(LabelTableFile, PipesAreRefusedWithoutWaiting)
{
  const fs::path pipe = m_Folder / "labels.txt";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_THROW(rhombic::ReadLabelTable(pipe), Failure);
}

TEST_F(LabelTableFile, FindsTablesBesideLabelMaps)
{
  const fs::path volume = m_Folder / "sub-01_dseg.nii.gz";
  std::ofstream(volume.string()) << ""; // no NIfTI at all
  EXPECT_FALSE(FindLabelTable(volume).has_value());

  const fs::path map = m_Folder / "body.seg.nrrd";
  EXPECT_FALSE(FindLabelTable(map).has_value());
  this->Write("body.txt", "These are the labels of the body.\n");
  this->Write("body.csv", "a,b\n1,2\n");
  EXPECT_FALSE(FindLabelTable(map).has_value());
  for (const char * const notes : { "2 lesions found\n", "2 lesions, checked twice\n", "2 lesions\n2 readers\n" })
  {
    this->Write("body.txt", notes);
    EXPECT_FALSE(FindLabelTable(map).has_value()) << notes;
  }
  this->Write("body.csv", "name,value\nvolume_ml,12.5\n");
  EXPECT_FALSE(FindLabelTable(map).has_value()) << "of measures";
  this->Write("body.tsv", BIDS);
  EXPECT_EQ(FindLabelTable(map)->size(), 2U);
  this->Write("body.ctbl", SlicerText);
  EXPECT_EQ(FindLabelTable(map)->size(), 3U);
  this->Write("body.ctbl", Replaced(SlicerText, "102", "1020"));
  EXPECT_THROW(FindLabelTable(map), Failure);
}

TEST_F(LabelTableFile, LongFilesAreRefusedWithAByteOrderMarkToo)
{
  const std::string lines(std::size_t{ 1 } << 20, '\n');
  for (const std::string mark : { "", "\xEF\xBB\xBF" })
  {
    this->Write("long.txt", mark + "1 liver\n" + lines + "junk\n");
    EXPECT_THROW(rhombic::ReadLabelTable(m_Folder / "long.txt"), Failure);
  }
}

TEST_F(LabelTableFile, FindsTheDatasetOfLabelMaps)
{
  const fs::path folder = m_Folder / "Dataset001" / "labelsTr";
  fs::create_directories(folder);
  EXPECT_FALSE(rhombic::FindDatasetTable(folder / "case_001.nii.gz").has_value());
  this->Write("Dataset001/dataset.json", "{\"labels\": {\"background\": 0, \"liver\": 1}}");
  EXPECT_EQ(rhombic::FindDatasetTable(folder / "case_001.nii.gz")->at(1).name, "liver");
  this->Write("Dataset001/labelsTr/dataset.json", "{\"Name\": \"of something else\"}");
  EXPECT_EQ(rhombic::FindDatasetTable(folder / "case_001.nii.gz")->at(1).name, "liver");
  this->Write("Dataset001/labelsTr/dataset.json", "{\"labels\": {\"spleen\": 1}}");
  EXPECT_EQ(rhombic::FindDatasetTable(folder / "case_001.nii.gz")->at(0).name, "spleen");
  this->Write("Dataset001/dataset.json", "{\"labels\": {\"whole tumour\": [1, 2], \"core\": 2}}");
  this->Write("Dataset001/labelsTr/dataset.json", "{\"labels\": [\"a\", \"b\"]}");
  EXPECT_FALSE(rhombic::FindDatasetTable(folder / "case_001.nii.gz").has_value()) << "names of no label map";
}

const std::map<std::string, std::string> Segments{
  { "Segmentation_MasterRepresentation", "Binary labelmap" },
  { "Segment0_ID", "liver" },
  { "Segment0_Name", "the liver" },
  { "Segment0_LabelValue", "3" },
  { "Segment0_Layer", "0" },
  { "Segment0_Color", "1 0.4 0" },
  { "Segment1_ID", "tumor" },
  { "Segment1_Name", "liver tumor" },
  { "Segment1_LabelValue", "1" },
  { "Segment1_Layer", "1" },
  { "Segment10_ID", "x" },
  { "Segment10_Name", "spleen" },
  { "Segment10_LabelValue", "1" },
  { "Segment10_Layer", "0" },
};

TEST(LabelsOfSegments, ReadsOneLayer)
{
  const LabelTable table = rhombic::LabelsOfSegments(Segments, "a.seg.nrrd");
  ASSERT_EQ(Values(table), (std::vector<std::int32_t>{ 1, 3 }));
  EXPECT_EQ(table[0].name, "spleen");
  EXPECT_EQ(table[0].colour, AnatomicalColour("spleen", 1));
  EXPECT_EQ(table[1].name, "the liver");
  EXPECT_EQ(table[1].colour, (Colour{ 255, 102, 0 }));
  const LabelTable second = rhombic::LabelsOfSegments(Segments, "a.seg.nrrd", 1);
  ASSERT_EQ(second.size(), 1U);
  EXPECT_EQ(second[0].name, "liver tumor");
  EXPECT_TRUE(rhombic::LabelsOfSegments({ { "space", "x" } }, "a").empty());
}

TEST(LabelsOfSegments, OldFilesHaveALayerForEachSegment)
{
  const LabelTable table =
    rhombic::LabelsOfSegments({ { "Segment0_Name", "a" }, { "Segment1_Name", "b" } }, "a.seg.nrrd", 1);
  ASSERT_EQ(Values(table), (std::vector<std::int32_t>{ 1 }));
  EXPECT_EQ(table[0].name, "b");
}

TEST(LabelsOfSegments, RefusesBadValues)
{
  const auto refusal = [](const std::string & key, const std::string & value) {
    std::map<std::string, std::string> keyValues = Segments;
    keyValues[key] = value;
    try
    {
      rhombic::LabelsOfSegments(keyValues, "a.seg.nrrd");
    }
    catch (const Failure & failure)
    {
      return std::string(failure.GetDescription());
    }
    return std::string();
  };
  EXPECT_NE(refusal("Segment0_LabelValue", "x").find("a.seg.nrrd, Segment0: the label's value"), std::string::npos);
  EXPECT_NE(refusal("Segment0_Color", "1 0 2").find("blue"), std::string::npos);
  EXPECT_NE(refusal("Segment0_Color", "1 0").find("colour"), std::string::npos);
  EXPECT_NE(refusal("Segment0_Layer", "-1").find("layer"), std::string::npos);
  EXPECT_NE(refusal("Segment0_LabelValue", "1").find("value 1 is given twice"), std::string::npos);
  EXPECT_EQ(refusal("Segment1_LabelValue", "1"), "");
}

const std::string Caret = "<?xml version=\"1.0\" encoding=\"UTF-8\"?> <CaretExtension><Date><![CDATA[now]]></Date>\n"
                          "<VolumeInformation Index=\"0\"><Label>not this</Label><LabelTable>\n"
                          "<Label Key=\"3\" Red=\"0.5\" Green=\"1\" Blue=\"0\" Alpha=\"0.25\"><![CDATA[a<b]]></Label>\n"
                          "<Label Key=\"1\" Red=\"0\" Green=\"1\" Blue=\"0\" Alpha=\"1\">x &amp; y</Label>\n"
                          "</LabelTable></VolumeInformation></CaretExtension>";

TEST(CaretLabels, AreRead)
{
  const LabelTable table = rhombic::ParseCaretLabels(Caret, "a");
  ASSERT_EQ(Values(table), (std::vector<std::int32_t>{ 1, 3 }));
  EXPECT_EQ(table[0].name, "x & y");
  EXPECT_EQ(table[1].name, "a<b");
  EXPECT_EQ(table[1].colour, (Colour{ 128, 255, 0 }));
  EXPECT_EQ(table[1].opacity, 0.25);
  EXPECT_TRUE(rhombic::ParseCaretLabels("<a/>", "a").empty());
}

TEST(CaretLabels, AreRefusedWhenDamaged)
{
  const auto refusal = [](const std::string & xml) {
    try
    {
      rhombic::ParseCaretLabels(xml, "a");
    }
    catch (const Failure & failure)
    {
      return std::string(failure.GetDescription());
    }
    return std::string();
  };
  EXPECT_NE(refusal(Caret.substr(0, 300)).find("XML is damaged"), std::string::npos);
  EXPECT_NE(refusal(Replaced(Caret, "Red=\"0.5\"", "Red=\"7\"")).find("line 3: red is \"7\""), std::string::npos);
  EXPECT_NE(refusal(Replaced(Caret, "Key=\"3\"", "")).find("line 3: the label's value"), std::string::npos);
  EXPECT_NE(refusal(Replaced(Caret, "Key=\"3\"", "Key=\"1\"")).find("line 4: value 1 is given twice"),
            std::string::npos);
  EXPECT_NE(refusal("<!DOCTYPE a [<!ENTITY x SYSTEM \"file:///etc/passwd\">]><a>&x;</a>").find("document type"),
            std::string::npos);
  EXPECT_NE(refusal(std::string(2 << 20, ' ')).find("1 MiB"), std::string::npos);
}

/** The beginning of a NIfTI-1 file with one extension, in either byte order. */
std::string
NIfTIWithExtension(const std::string & text, std::int32_t code, bool isSwapped, std::int32_t excess = 0)
{
  const auto put = [isSwapped](std::string & bytes, std::size_t at, auto value) {
    char raw[sizeof(value)];
    std::memcpy(raw, &value, sizeof(value));
    if (isSwapped)
    {
      std::reverse(raw, raw + sizeof(value));
    }
    bytes.replace(at, sizeof(value), raw, sizeof(value));
  };
  std::string bytes(352 + 8, '\0');
  put(bytes, 0, std::int32_t{ 348 });
  put(bytes, 108, static_cast<float>(bytes.size() + text.size()));
  bytes.replace(344, 3, "n+1");
  bytes[348] = 1;
  put(bytes, 352, static_cast<std::int32_t>(text.size() + 8) + excess);
  put(bytes, 356, code);
  return bytes + text + "voxels";
}

TEST_F(LabelTableFile, FindsTablesInNIfTI)
{
  for (const bool isSwapped : { false, true })
  {
    const auto find = [&](std::int32_t code, std::int32_t excess) {
      return FindLabelTable(this->Write("a.nii", NIfTIWithExtension(Caret + " \0\0", code, isSwapped, excess)));
    };
    ASSERT_TRUE(find(30, 0).has_value());
    EXPECT_EQ(Values(*find(30, 0)), (std::vector<std::int32_t>{ 1, 3 }));
    EXPECT_TRUE(find(0, 0).has_value());
    EXPECT_FALSE(find(6, 0).has_value()); // a comment
    EXPECT_THROW(find(30, 1), Failure);
    EXPECT_THROW(find(30, -10'000'000), Failure);
    EXPECT_THROW(find(30, std::numeric_limits<std::int32_t>::max() - 10'000), Failure);
  }
  EXPECT_FALSE(FindLabelTable(this->Write("b.nii", "no header")).has_value());
  EXPECT_FALSE(FindLabelTable(this->Write("b.nii", NIfTIWithExtension("", 30, false).substr(0, 348))).has_value());
}

int
Distance(const Colour & a, const Colour & b)
{
  return std::abs(a[0] - b[0]) + std::abs(a[1] - b[1]) + std::abs(a[2] - b[2]);
}

TEST(AnatomicalColours, NeighboursDiffer)
{
  const std::pair<const char *, const char *> neighbours[] = {
    { "liver", "gallbladder" },
    { "liver", "stomach" },
    { "liver", "kidney_right" },
    { "liver", "colon" },
    { "liver", "heart" },
    { "spleen", "kidney_left" },
    { "spleen", "stomach" },
    { "stomach", "esophagus" },
    { "stomach", "pancreas" },
    { "pancreas", "duodenum" },
    { "small_bowel", "colon" },
    { "small_bowel", "duodenum" },
    { "urinary_bladder", "prostate" },
    { "kidney_left", "adrenal_gland_left" },
    { "aorta", "inferior_vena_cava" },
    { "aorta", "iliac_artery_left" },
    { "portal_vein_and_splenic_vein", "inferior_vena_cava" },
    { "pulmonary_artery", "pulmonary_vein" },
    { "heart_atrium_left", "heart_ventricle_left" },
    { "heart_myocardium", "heart_ventricle_left" },
    { "lung_upper_lobe_left", "lung_lower_lobe_left" },
    { "lung_middle_lobe_right", "lung_lower_lobe_right" },
    { "trachea", "esophagus" },
    { "trachea", "thyroid_gland" },
    { "vertebrae_L1", "vertebrae_L2" },
    { "rib_left_4", "rib_left_5" },
    { "rib_left_4", "costal_cartilages" },
    { "hip_left", "femur_left" },
    { "hip_left", "sacrum" },
    { "sternum", "costal_cartilages" },
    { "vertebrae_L3", "spinal_cord" },
    { "gluteus_maximus_left", "gluteus_medius_left" },
    { "gluteus_medius_left", "gluteus_minimus_left" },
    { "gluteus_maximus_left", "hip_left" },
    { "brain", "skull" },
    { "skin", "skull" },
    { "clavicula_left", "scapula_left" },
    { "clavicula_right", "sternum" },
    { "scapula_right", "humerus_right" },
    { "hip_right", "sacrum" },
    { "colon", "kidney_left" },
    { "Left-Cerebral-White-Matter", "Left-Cerebral-Cortex" },
    { "liver_tumor", "liver" },
    { "kidney_cyst_left", "kidney_left" },
  };
  for (const auto & [a, b] : neighbours)
  {
    EXPECT_GE(Distance(AnatomicalColour(a, 1), AnatomicalColour(b, 1)), 25) << a << " and " << b;
  }
}

TEST(AnatomicalColours, LeftIsNotRight)
{
  for (const std::string organ : { "kidney", "lung_upper_lobe", "femur", "gluteus_maximus", "iliac_vena", "eye" })
  {
    const int distance = Distance(AnatomicalColour(organ + "_left", 1), AnatomicalColour(organ + "_right", 1));
    EXPECT_GE(distance, 8) << organ;
    EXPECT_LE(distance, 150) << organ;
  }
}

TEST(AnatomicalColours, DoNotDependOnHowANameIsWritten)
{
  for (const std::string name : { "Left-Kidney", "left kidney", "KIDNEY_LEFT", "kidneyLeft", "Kidney L" })
  {
    EXPECT_EQ(AnatomicalColour(name, 9), AnatomicalColour("kidney_left", 2)) << name;
  }
  EXPECT_EQ(AnatomicalColour("L1 vertebra", 1), AnatomicalColour("vertebrae_T11", 2));
  EXPECT_NE(AnatomicalColour("urinary bladder", 1), AnatomicalColour("gallbladder", 1));
  EXPECT_NE(AnatomicalColour("pulmonary vein", 1), AnatomicalColour("renal vein", 1));
}

TEST(AnatomicalColours, OfUnknownNamesHaveOneHueOnBothSides)
{
  for (const std::string name : { "thing", "choroid-plexus", "vessel of something" })
  {
    const Colour left = AnatomicalColour(name + " left", 5);
    const Colour right = AnatomicalColour(name + " right", 11);
    EXPECT_EQ(left, rhombic::Lighten(right, 0.2)) << name;
    EXPECT_EQ(AnatomicalColour("Left-" + name, 3), left) << name;
    EXPECT_NE(left, right);
  }
}

TEST(AnatomicalColours, NamesHaveGroups)
{
  const std::pair<const char *, const char *> groups[] = {
    { "vertebrae_L1", "bones" },
    { "rib_left_4", "bones" },
    { "aorta", "vessels" },
    { "portal_vein", "vessels" },
    { "gluteus_maximus_left", "muscles" },
    { "kidney_right", "organs" },
    { "lung_upper_lobe_left", "organs" },
    { "liver_tumor", "findings" },
    { "skin", "tissues" },
    { "Left-Hippocampus", "brain and nerves" },
    { "thing", "" },
  };
  for (const auto & [name, group] : groups)
  {
    EXPECT_EQ(rhombic::FindAnatomicalGroup(name), group) << name;
  }
}

/** L*, a* and b* of CIELAB, for the white of sRGB (IEC 61966-2-1). */
std::array<double, 3>
LabOf(const Colour & colour)
{
  constexpr double rows[3][3] = { { 0.4339, 0.3762, 0.1899 }, { 0.2126, 0.7152, 0.0722 }, { 0.0177, 0.1095, 0.8728 } };
  std::array<double, 3> roots{}; // of X, Y and Z as shares of the white's
  for (std::size_t row = 0; row < 3; ++row)
  {
    double share = 0.0;
    for (std::size_t channel = 0; channel < 3; ++channel)
    {
      share += rows[row][channel] * rhombic::SRGBToLinear(colour[channel] / 255.0);
    }
    roots[row] = share > 0.008856 ? std::cbrt(share) : 7.787 * share + 16.0 / 116.0;
  }
  return { 116.0 * roots[1] - 16.0, 500.0 * (roots[0] - roots[1]), 200.0 * (roots[1] - roots[2]) };
}

TEST(AnatomicalColours, OfUnknownNamesAreQuietAndDifferByValue)
{
  for (int a = 0; a < 112; ++a)
  {
    const Colour colour = AnatomicalColour("thing", a);
    EXPECT_EQ(colour, AnatomicalColour("", a));
    const std::array<double, 3> lab = LabOf(colour);
    EXPECT_LE(std::hypot(lab[1], lab[2]), 45.0) << a; // chroma; that of sRGB's red is 104
    for (int b = 0; b < a; ++b)
    {
      EXPECT_NE(colour, AnatomicalColour("thing", b)) << a << " and " << b;
      const std::array<double, 3> other = LabOf(AnatomicalColour("thing", b));
      const double difference = std::hypot(lab[0] - other[0], std::hypot(lab[1] - other[1], lab[2] - other[2]));
      EXPECT_GE(a < 16 ? difference : 18.0, 18.0) << a << " and " << b; // 2 can just be seen
    }
  }
}

TEST(RealLabelTables, OfTotalSegmentator)
{
  const char * const scans = std::getenv("RHOMBIC_SCANS");
  if (scans == nullptr)
  {
    GTEST_SKIP() << "RHOMBIC_SCANS is not set";
  }
  const fs::path folder = fs::path(scans) / "ct_body_totalseg_nifti";
  for (const char * const name :
       { "example_seg.nii.gz", "example_seg_dicom.nii.gz", "example_seg_fast_force_split.nii.gz" })
  {
    const auto table = FindLabelTable(folder / name);
    ASSERT_TRUE(table.has_value()) << name;
    ASSERT_EQ(table->size(), 117U) << name;
    EXPECT_EQ((*table)[0].name, "spleen");
    EXPECT_EQ((*table)[0].colour, (Colour{ 0, 255, 0 }));
    EXPECT_EQ((*table)[5].name, "stomach");
    EXPECT_EQ((*table)[5].colour, (Colour{ 255, 128, 0 }));
    EXPECT_EQ((*table)[116].value, 117);
    EXPECT_EQ((*table)[116].name, "costal_cartilages");
    EXPECT_EQ((*table)[116].colour, (Colour{ 0, 128, 255 }));
    EXPECT_EQ((*table)[116].opacity, 1);

    std::size_t numberOfUnknown = 0;
    for (const Label & label : *table)
    {
      const bool isUnknown = AnatomicalColour(label.name, label.value) == AnatomicalColour("", label.value);
      numberOfUnknown += isUnknown ? 1 : 0;
      EXPECT_FALSE(isUnknown) << label.name;
      EXPECT_EQ(rhombic::FileStemOf(label.name), label.name);
    }
    EXPECT_EQ(numberOfUnknown, 0U);
  }
  EXPECT_FALSE(FindLabelTable(folder / "example_ct.nii.gz").has_value());
}

} // namespace
