#include "report/vtk.h"

#include "sample_results.h"

#include <pugixml.hpp>

namespace whirl::report {

namespace {

std::vector<double> numbers(const pugi::xml_node &array) {
    std::istringstream stream(array.child_value());
    std::vector<double> values;
    for (double value; stream >> value;)
        values.push_back(value);
    return values;
}

} // namespace

TEST(Vtk, ArraysHaveTheDeclaredSizesAndCellsPointAtPoints) {
    pugi::xml_document document;
    ASSERT_TRUE(document.load_string(to_vtp(sample_case(), sample_modes()).c_str()));
    EXPECT_STREQ(document.child("VTKFile").attribute("type").value(), "PolyData");
    const auto piece = document.child("VTKFile").child("PolyData").child("Piece");
    const auto points = static_cast<std::size_t>(piece.attribute("NumberOfPoints").as_uint());
    ASSERT_GT(points, 3u);
    EXPECT_EQ(numbers(piece.child("Points").child("DataArray")).size(), 3 * points);
    std::size_t arrays = 0;
    for (const auto &array : piece.child("PointData").children("DataArray")) {
        EXPECT_EQ(numbers(array).size(), 3 * points) << array.attribute("Name").value();
        ++arrays;
    }
    EXPECT_EQ(arrays, 4u) << "real and imaginary part of two modes";
    for (const char *kind : {"Lines", "Polys"}) {
        const auto cells = piece.child(kind);
        const auto corners = numbers(cells.find_child_by_attribute("Name", "connectivity"));
        const auto ends = numbers(cells.find_child_by_attribute("Name", "offsets"));
        ASSERT_FALSE(ends.empty());
        EXPECT_EQ(static_cast<std::size_t>(ends.back()), corners.size()) << kind;
        EXPECT_EQ(ends.size(), piece.attribute(("NumberOf" + std::string(kind)).c_str()).as_uint());
        for (const double corner : corners)
            EXPECT_LT(corner, static_cast<double>(points)) << kind;
    }
}

TEST(Vtk, ModesAtCriticalSpeedsAreToldFromThoseAtOneSpeed) {
    results::ModesResult result = sample_modes();
    result.critical = {result.modes[1]};
    result.critical[0].at = 250;
    pugi::xml_document document;
    ASSERT_TRUE(document.load_string(to_vtp(sample_case(), result).c_str()));
    const auto data = document.child("VTKFile").child("PolyData").child("Piece").child("PointData");
    for (const char *name : {"1F real", "1F imag", "critical 1 1F at 250 rad/s real",
                             "critical 1 1F at 250 rad/s imag"})
        EXPECT_TRUE(data.find_child_by_attribute("Name", name)) << name;
}

TEST(Vtk, SurfaceHasTheShaftsRadius) {
    pugi::xml_document document;
    ASSERT_TRUE(document.load_string(to_vtp(sample_case(), sample_modes()).c_str()));
    const auto piece = document.child("VTKFile").child("PolyData").child("Piece");
    const auto places = numbers(piece.child("Points").child("DataArray"));
    for (std::size_t i = 3 * 3; i + 2 < places.size(); i += 3) // after the three centre points
        EXPECT_NEAR(std::hypot(places[i], places[i + 1]), 0.025, 1e-9); // nine digits are written
}

} // namespace whirl::report
