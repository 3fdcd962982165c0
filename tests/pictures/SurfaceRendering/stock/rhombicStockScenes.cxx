/** rhombic-stock-scenes <headless|x> <folder>: draws scenes of plain VTK in vtkRhombicHeadlessRenderWindow, or in VTK's
 * own window on an X display, and writes <scene>.raw: RGBA bytes, then depths as floats. check-xvfb.sh compares both.
 */

#include "rhombicStockScenes.h"
#include "vtkRhombicHeadlessRenderWindow.h"

#include <vtkAutoInit.h>
#include <vtkFloatArray.h>
#include <vtkUnsignedCharArray.h>

#include <fstream>
#include <iostream>
#include <string>

VTK_MODULE_INIT(vtkRenderingFreeType)

namespace
{

using namespace rhombic::test;

bool
Write(vtkRenderWindow * window, const std::string & file)
{
  vtkNew<vtkUnsignedCharArray> pixels;
  vtkNew<vtkFloatArray> depths;
  window->GetRGBACharPixelData(0, 0, StockWidth - 1, StockHeight - 1, 0, pixels);
  window->GetZbufferData(0, 0, StockWidth - 1, StockHeight - 1, depths);
  std::ofstream out(file, std::ios::binary);
  out.write(reinterpret_cast<const char *>(pixels->GetPointer(0)), pixels->GetNumberOfValues());
  out.write(reinterpret_cast<const char *>(depths->GetPointer(0)),
            depths->GetNumberOfValues() * static_cast<std::streamsize>(sizeof(float)));
  return pixels->GetNumberOfTuples() == StockWidth * StockHeight &&
         depths->GetNumberOfTuples() == StockWidth * StockHeight && out.flush().good();
}

} // namespace

int
main(int argc, char * argv[])
{
  if (argc != 3)
  {
    std::cerr << "Usage: rhombic-stock-scenes <headless|x|x-beside-headless> <folder>\n";
    return 2;
  }
  const std::string mode = argv[1];
  for (const StockScene & scene : StockScenes)
  {
    vtkSmartPointer<vtkRenderWindow> window;
    if (mode == "headless")
    {
      window = vtkSmartPointer<vtkRhombicHeadlessRenderWindow>::New();
    }
    else
    {
      window = vtkSmartPointer<vtkRenderWindow>::New();
      window->SetOffScreenRendering(1);
    }
    DrawStockScene(window, scene);
    if (mode == "x-beside-headless")
    {
      vtkNew<vtkRhombicHeadlessRenderWindow> other;
      other->PushContext();
      DrawStockScene(other, scene);
      other->PopContext();
      window->Render();
    }
    if (!Write(window, std::string(argv[2]) + "/" + scene.name + ".raw"))
    {
      std::cerr << scene.name << " can't be read or written\n";
      return 1;
    }
    std::cout << scene.name << ": " << window->GetClassName() << '\n';
  }
  return 0;
}
