// SPDX-License-Identifier: BSD-3-Clause
// The table that scaling.py prints as a chart: ScalingChart FOLDER < TABLE writes FOLDER/scaling.svg and .png.
#include "ChartFiles.h"
#include "LogChart.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

using nephoscope::charts::ChartCurve;
using nephoscope::charts::ChartPoint;
using nephoscope::charts::LogChart;

namespace
{
/// A row of the table.
struct Measured
{
  double processes = 0;
  double read = 0;       ///< s
  double picture = 0;    ///< s
  double efficiency = 0; ///< percent
  double memory = 0;     ///< MB
};

using Table = std::map<std::string, std::vector<Measured>>; ///< by the kind of scaling

Table tableOf(std::istream& lines)
{
  Table table;
  std::string line;
  while (std::getline(lines, line))
  {
    char kind[16];
    Measured row;
    if (std::sscanf(line.c_str(), "| %15[a-z] | %lf | %lf | %lf | %lf %% | %lf |", kind,
          &row.processes, &row.read, &row.picture, &row.efficiency, &row.memory) == 6)
    {
      table[kind].push_back(row);
    }
  }
  return table;
}

ChartCurve curveOf(const std::vector<Measured>& rows, double Measured::*seconds,
  const std::string& name, const std::string& detail)
{
  ChartCurve curve;
  for (const Measured& row : rows)
  {
    curve.points.push_back({ row.processes, row.*seconds, name, detail, true });
  }
  return curve;
}

/// "100, 80, 60 %; 239, 222, 180 MB each".
std::string detailOf(const std::vector<Measured>& rows)
{
  std::string efficient;
  std::string memory;
  for (const Measured& row : rows)
  {
    efficient += (efficient.empty() ? "" : ", ") + std::to_string(std::lround(row.efficiency));
    memory += (memory.empty() ? "" : ", ") + std::to_string(std::lround(row.memory));
  }
  return efficient + " %; " + memory + " MB each";
}

LogChart chartOf(const Table& table)
{
  LogChart chart;
  chart.title = "A picture by several processes";
  chart.subtitle =
    "fog and a surface in it, one thread a process; weak: as many times the pixels. Small: "
    "efficiency of the cores, memory of the largest";
  chart.xLabel = "processes";
  chart.yLabel = "seconds";
  chart.xUnit = nephoscope::charts::Unit::Count;
  chart.yUnit = nephoscope::charts::Unit::Seconds;
  for (const auto& [kind, rows] : table)
  {
    chart.curves.push_back(
      curveOf(rows, &Measured::picture, "picture, " + kind + " scaling", detailOf(rows)));
  }
  const std::vector<Measured>& strong = table.at("strong");
  chart.curves.push_back(curveOf(strong, &Measured::read, "reading and contouring, strong", ""));
  ChartCurve ideal;
  for (const Measured& row : strong)
  {
    ideal.points.push_back(
      { row.processes, strong[0].picture / row.processes, "in inverse proportion", "", false });
  }
  chart.curves.push_back(ideal);
  return chart;
}
}

int main(int argc, char* argv[])
{
  const Table table = tableOf(std::cin);
  if (argc != 2 || table.count("strong") == 0)
  {
    std::cerr << "ScalingChart FOLDER < TABLE, as scaling.py prints it\n";
    return 1;
  }
  try
  {
    nephoscope::charts::makeFolder(argv[1]);
    nephoscope::charts::writeChartFiles(chartOf(table), argv[1], "scaling");
  }
  catch (const std::runtime_error& problem)
  {
    std::cerr << problem.what() << '\n';
    return 1;
  }
  return 0;
}
