mod damage;
mod dome;
mod formats;
mod loading;
mod lookup;
mod made;
mod pyramid;
mod shared;
