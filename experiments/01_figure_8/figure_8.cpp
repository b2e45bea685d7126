#include "measure.h"
#include <cstdio>
#include <cstring>
#include <fstream>
#include <iterator>
using namespace cellwalk; using namespace cellwalk::figure_8;
int main(int argc,char**argv){
  std::ifstream in(argv[1],std::ios::binary); std::vector<char> d((std::istreambuf_iterator<char>(in)),{});
  auto u=[&](size_t o){uint32_t x;memcpy(&x,d.data()+o,4);return x;};
  uint32_t nx=u(8),ny=u(12),nz=u(16),B=u(20),S=u(24),O=u(28); size_t o=64; std::vector<uint32_t> solid(O); memcpy(solid.data(),d.data()+o,4*O); o+=4*(O+O%2);
  std::vector<Point<3>> init(B*8),t(size_t(S)*B*8); memcpy(init.data(),d.data()+o,init.size()*24); o+=init.size()*24; memcpy(t.data(),d.data()+o,t.size()*24); o+=t.size()*24; std::vector<uint8_t> a(t.size()); memcpy(a.data(),d.data()+o,a.size());
  World w=grid_world({nx,ny,nz},solid); printf("walls %zu\n",w.walls.triangles.size());
  Motion m{B,S,init,t,a};
  Measure_options opt; if(argc>2) opt.rounds=atoi(argv[2]); if(argc>3) opt.only=argv[3];
  for(auto&r:measure(w,m,families(),opt)){ double n=m.moves(); printf("%-28s %8.1f ns  hits %lu missed %lu false %lu  build %.0f ms %.1f B  box %.3f seg %.3f tri %.3f walk %.3f cross %.3f cert %.3f\n",r.method.c_str(),r.median(),r.hits,r.wrong.missed,r.wrong.reported,r.build.milliseconds,r.build.bytes/double(r.build.per[0]=='w'?w.walls.triangles.size():w.cell_count()),r.counts.boxes/n,r.counts.segments/n,r.counts.triangle_tests/n,r.counts.walks/n,r.counts.crossings/n,r.counts.certified/n);}
}
