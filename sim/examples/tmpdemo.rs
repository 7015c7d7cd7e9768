use awl_sim::{machine::*, operand::*, symbols::*, trace::*, plant};
use std::collections::HashMap;
struct M(HashMap<Operand,i32>);
impl Machine for M {
 fn write(&mut self,o:Operand,v:i32)->Result<(),MachineError>{self.0.insert(o,v);Ok(())}
 fn read(&mut self,o:Operand)->Result<i32,MachineError>{Ok(self.0.get(&o).copied().unwrap_or(0))}
 fn scan(&mut self,_:u64){} fn mode(&self)->Mode{Mode::Run} fn fault(&self)->Option<String>{None}
 fn pin_levels(&mut self)->u8{0xFF} fn drive_pin(&mut self,_:u8,_:bool){}
}
fn main(){
 let a:Vec<String>=std::env::args().collect();
 let n:u64=a[1].parse().unwrap(); let s:u64=a[2].parse().unwrap(); let k:usize=a[3].parse().unwrap();
 let mut sy=Symbols::new();
 for (n,ad,c) in [("PieceThere","I0.0","workpiece at the bottom"),("AtBottom","I0.1","platform down"),("Raise","Q0.1","raise the platform"),("Delay","T101",""),("Height","MW3","reading of the height sensor, taken once per piece and kept until the next"),("Seen","C5","")]{sy.add(n,awl_asm::Address::parse(ad).unwrap(),c);}
 let all="I0.0,I0.1,I0.2,Q0.0,Q0.1,Q0.2,M0.0,M0.1,T101,T101.cv,C5,C5.cv,MW3,Ain0,AIW2,VB7,MW10,SM0.5,Q0.3,Q0.4,I0.3,I0.4,I0.5,M1.0,M1.1,M1.2,M1.3,T37,T37.cv,VW100";
 let names:Vec<&str>=all.split(',').take(k).collect();
 let sig:Vec<Signal>=names.iter().map(|t|Signal::parse(t,&sy).unwrap()).collect();
 let mut m=M(HashMap::new()); let mut t=Trace::new(sig.clone(),s);
 let mut r=fastrand::Rng::with_seed(3);
 let total=n*s;
 for i in 0..n{ let now=i*s; let f=now as f64/total as f64;
  for (j,g) in sig.iter().enumerate(){
   let p=1.0+j as f64; let ph=(f*p*2.3+j as f64*0.37).fract();
   let v=match &*g.name {
    "T101.cv"=>{let q=(f*5.0).fract(); if q<0.3{0}else{((q-0.3)*total as f64/5.0/100.0) as i32}},
    "T37.cv"=>{(now/100%70) as i32},
    "C5.cv"=>(f*9.0) as i32, "MW3"=>[0,190,207,228,0,207][(f*5.99) as usize], "MW10"=>-3000,
    "Ain0"=>if (0.3..0.6).contains(&(f*3.0).fract()){207+r.i32(-3..=3)}else{12+r.i32(-2..=2)},
    "AIW2"=>(16000.0+12000.0*(f*12.0).sin()) as i32, "VB7"=>((f*40.0) as i32*37)%256, "VW100"=>-100+((f*6.0) as i32)*50,
    "SM0.5"=>(now/500%2) as i32,
    _=>i32::from(ph<0.4)};
   m.write(g.operand,v).unwrap();
  }
  t.record(&mut m).unwrap();
 }
 let _=plant::PLANTS;
 svg::write(&t,"station1.awl",&mut std::io::stdout()).unwrap();
}
