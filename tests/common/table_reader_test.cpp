// Tables as people and spreadsheets write them, and what is no such table.
#include "common/table_reader.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "tests/support/text_forms.hpp"

namespace fc {
namespace {

const std::filesystem::path kFile =
    std::filesystem::path(testing::TempDir()) / ("fc_table_reader_" + std::to_string(getpid()) + ".csv");

ReadTable read(const std::string& bytes) {
  std::ofstream(kFile, std::ios::binary) << bytes;
  return read_table(kFile, "name,x,y");
}

// The line that refuses it, without the path; or "read".
std::string refusal(const std::string& bytes) {
  try {
    const ReadTable table = read(bytes);
    for (const ReadTable::Row& row : table.rows) {
      table.number(row, 1);
      table.number(row, 2);
    }
  } catch (const InputError& error) {
    return std::string(error.what()).substr(kFile.string().size());
  }
  return "read";
}

using Cells = std::vector<std::vector<std::string>>;

Cells cells(const std::string& bytes) {
  Cells all;
  for (const ReadTable::Row& row : read(bytes).rows) all.push_back(row.cells);
  return all;
}

TEST(TableReader, MarksAndLineEndsChangeNothing) {
  const std::string text = "name,x,y\na,1,2\n\n  \t\nb , 3 ,\t4\n";
  for (const auto& [form, bytes] : fc_test::forms_of(text)) {
    EXPECT_EQ(cells(bytes), (Cells{{"a", "1", "2"}, {"b", "3", "4"}})) << form;
    EXPECT_EQ(read(bytes).rows[1].line, 5) << form;
    EXPECT_EQ(refusal(bytes.substr(0, bytes.size() - (form.find("CRLF") == std::string::npos ? 1 : 2))),
              "read")
        << form;
  }
  EXPECT_EQ(cells("\nname,x,y\na,1,2"), (Cells{{"a", "1", "2"}}));
}

TEST(TableReader, FormsOfNumbersChangeNothing) {
  for (const std::string& three : fc_test::kThrees) {
    const ReadTable table = read("name,x,y\na," + three + ", \"" + three + "\"\n");
    EXPECT_EQ(table.number(table.rows[0], 1), 3) << three;
    EXPECT_EQ(table.number(table.rows[0], 2), 3) << three;
  }
  for (const std::string& no_number : fc_test::kNoNumbers) {
    if (no_number == "3,0") continue;  // two cells
    EXPECT_EQ(refusal("name,x,y\na,0,  " + no_number + " \n"),
              ":2:7: \"" + no_number + "\" is not a finite number; write one, for example 0.5");
  }
  EXPECT_EQ(refusal("name,x,y\na,3,0,1\n"), ":2:7: 4 cells; a row has 3, as the header");
}

TEST(TableReader, QuotesAroundCells) {
  EXPECT_EQ(cells("\"name\", \"x\",\"y\"\n\"a, \"\"b\"\"\",1,2\n"), (Cells{{"a, \"b\"", "1", "2"}}));
  EXPECT_EQ(refusal("name,x,y\n\"a,1,2\n"),
            ":2:1: a quote begins here and does not end with the cell; write the cell without quotes");
  EXPECT_EQ(refusal("name,x,y\n\"a\"b,1,2\n"),
            ":2:1: a quote begins here and does not end with the cell; write the cell without quotes");
}

TEST(TableReader, AnotherHeaderIsRefusedAtTheNameThatDiffers) {
  const std::string must = "; the header must be name,x,y";
  EXPECT_EQ(refusal("name,y,x\n"), ":1:6: 'y' stands where 'x' should" + must);
  EXPECT_EQ(refusal("name,x,x\n"), ":1:8: 'x' stands where 'y' should" + must);
  EXPECT_EQ(refusal("name,x,y,z\n"), ":1:10: 'z' is one name too many" + must);
  EXPECT_EQ(refusal("name,x,y,y\n"), ":1:10: 'y' is one name too many" + must);
  EXPECT_EQ(refusal("name,x\n"), ":1:7: 'y' is missing" + must);
  EXPECT_EQ(refusal("a,1,2\n"), ":1:1: 'a' stands where 'name' should" + must);
  EXPECT_EQ(refusal("name;x;y\na;1;2\n"), ":1:1: the cells are not separated by commas" + must);
  EXPECT_EQ(refusal("name\tx\ty\n"), ":1:1: the cells are not separated by commas" + must);
  EXPECT_EQ(refusal(""), ":1:1: the file is empty" + must);
  EXPECT_EQ(refusal("\xEF\xBB\xBF\r\n"), ":1:1: the file is empty" + must);
}

TEST(TableReader, RowsHaveAsManyCellsAsTheHeader) {
  EXPECT_EQ(refusal("name,x,y\na,1\n"), ":2:3: 2 cells; a row has 3, as the header");
  EXPECT_EQ(refusal("name,x,y\na,1,2,\n"), ":2:7: 4 cells; a row has 3, as the header");
  EXPECT_EQ(refusal("name,x,y\na,1,\n"), ":2:5: \"\" is not a finite number; write one, for example 0.5");
  EXPECT_EQ(refusal("name,x,y\n# a remark\n"), ":2:1: 1 cells; a row has 3, as the header");
}

TEST(TableReader, WhatIsNoTableIsNamed) {
  EXPECT_EQ(refusal("\x1f\x8b\x08 packed"), ": is gzip data, not a table; unpack it first");
  EXPECT_EQ(refusal("\xff\xfen\0a\0"), ": is UTF-16 text, not a table; save it as UTF-8");
  EXPECT_EQ(refusal(std::string("n\0a\0m\0e\0,\0", 10)), ": is UTF-16 text, not a table; save it as UTF-8");
  EXPECT_EQ(refusal("v 0 0 0\n"), ": is an OBJ mesh, not a table; name it .obj");
  EXPECT_EQ(refusal(std::string("name,x,y\na,1\0,2\n", 16)),
            ":2:4: a zero byte: binary data, so it is not a table; check the file's name and content");
  EXPECT_THROW(read_table(testing::TempDir(), "name,x,y"), InputError);
  EXPECT_THROW(read_table("/nonexistent.csv", "name,x,y"), InputError);
}

// A line that begins with any word of its own never goes unnoticed: it is a row, or it is refused.
RC_GTEST_PROP(TableReader, NoLineIsPassedOver, ()) {
  const std::string word =
      *rc::gen::container<std::string>(*rc::gen::inRange(1, 8), rc::gen::inRange<char>('!', '~'));
  RC_PRE(word.find_first_of(",\"") == std::string::npos);
  RC_ASSERT(refusal("name,x,y\n" + word + "\na,1,2\n") == ":2:1: 1 cells; a row has 3, as the header");
  RC_ASSERT(refusal("name,x,y\na,1,2\n" + word + "\n") == ":3:1: 1 cells; a row has 3, as the header");
  RC_ASSERT(refusal(word + "\nname,x,y\na,1,2\n") != "read");
  RC_ASSERT(cells("name,x,y\n" + word + ",1,2\n").at(0).at(0) == word);
}

}  // namespace
}  // namespace fc
