//! POV-Ray's command line and INI files: which option each word sets.
//!
//! **Source:** POV-Ray 3.7 manual, section 3.2, and the program, measured.

use std::path::{Path, PathBuf};

use super::settings::{Problem, Settings};

/// INI files include each other at most so deep.
const MOST_NESTED: u32 = 16;

/// How a switch is read: `+` or `-`, a name, and what stands behind it.
enum Kind {
    /// Sets an option to what stands behind.
    Value(&'static str),
    /// `+` is on and `-` off.
    Switch(&'static str),
    /// As `Switch`, and a value for another option if one stands behind.
    Both(&'static str, &'static str),
    /// Of the type of picture.
    Type,
    /// Nothing here changes by it.
    Ignored,
}

use Kind::{Both, Ignored, Switch, Type, Value};

/// Of several that fit, the longest is meant.
const SWITCHES: &[(&str, Kind)] = &[
    ("a", Both("antialias", "antialias_threshold")),
    ("ac", Value("antialias_confidence")),
    ("ag", Value("antialias_gamma")),
    ("am", Value("sampling_method")),
    ("b", Ignored),
    ("bm", Ignored),
    ("bp", Ignored),
    ("bs", Ignored),
    ("c", Switch("continue_trace")),
    ("d", Ignored),
    ("ec", Value("end_column")),
    ("ef", Value("subset_end_frame")),
    ("ep", Ignored),
    ("er", Value("end_row")),
    ("f", Type),
    ("ga", Both("all_console", "all_file")),
    ("gd", Both("debug_console", "debug_file")),
    ("gf", Both("fatal_console", "fatal_file")),
    ("gi", Value("create_ini")),
    ("gp", Switch("append_file")),
    ("gr", Both("render_console", "render_file")),
    ("gs", Both("statistic_console", "statistic_file")),
    ("gw", Both("warning_console", "warning_file")),
    ("h", Value("height")),
    ("hi", Value("include_header")),
    ("hn", Ignored),
    ("hr", Ignored),
    ("hs", Ignored),
    ("ht", Ignored),
    ("i", Value("input_file_name")),
    ("j", Ignored),
    ("k", Value("clock")),
    ("kc", Switch("cyclic_animation")),
    ("kf", Value("final_clock")),
    ("kff", Value("final_frame")),
    ("kfi", Value("initial_frame")),
    ("ki", Value("initial_clock")),
    ("l", Value("library_path")),
    ("mb", Ignored),
    ("mi", Ignored),
    ("mv", Value("version")),
    ("o", Value("output_file_name")),
    ("p", Ignored),
    ("q", Value("quality")),
    ("qr", Ignored),
    ("r", Value("antialias_depth")),
    ("rf", Value("radiosity_file_name")),
    ("rfi", Switch("radiosity_from_file")),
    ("rfo", Switch("radiosity_to_file")),
    ("rp", Ignored),
    ("rs", Ignored),
    ("rtr", Ignored),
    ("rvp", Switch("radiosity_vain_pretrace")),
    ("sc", Value("start_column")),
    ("sf", Value("subset_start_frame")),
    ("sp", Ignored),
    ("sr", Value("start_row")),
    ("ss", Ignored),
    ("stp", Value("frame_step")),
    ("su", Ignored),
    ("tho", Ignored),
    ("th", Ignored),
    ("ua", Switch("output_alpha")),
    ("ud", Ignored),
    ("uf", Switch("field_render")),
    ("ul", Ignored),
    ("uo", Switch("odd_field")),
    ("ur", Ignored),
    ("uv", Ignored),
    ("v", Switch("verbose")),
    ("w", Value("width")),
    ("wl", Ignored),
    ("wt", Value("work_threads")),
    ("x", Ignored),
];

impl Settings {
    /// Reads the words of a command line: one may hold several options. `read` returns the text of an INI file.
    pub fn take(
        &mut self,
        words: &[String],
        read: &dyn Fn(&Path) -> Option<String>,
    ) -> Result<(), Problem> {
        words.iter().flat_map(|word| parts(word)).try_for_each(|word| self.take_one(&word, read))
    }

    fn take_one(
        &mut self,
        word: &str,
        read: &dyn Fn(&Path) -> Option<String>,
    ) -> Result<(), Problem> {
        match word.chars().next() {
            None => Ok(()),
            Some(sign @ ('+' | '-')) => self.switch(sign == '+', &unquoted(&word[1..])),
            Some(_) => {
                let name = word.split('=').next().unwrap_or_default();
                let is_name = name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_');
                if let Some((name, value)) = word.split_once('=').filter(|_| is_name) {
                    return self.set(name, &unquoted(value));
                }
                let file = unquoted(word);
                match file.to_ascii_lowercase().ends_with(".pov") {
                    true => self.set("input_file_name", &file),
                    false => self.take_file(&file, read),
                }
            }
        }
    }

    fn switch(&mut self, is_on: bool, word: &str) -> Result<(), Problem> {
        let lower = word.to_ascii_lowercase();
        let fits = SWITCHES.iter().filter(|(name, _)| lower.starts_with(name));
        let (name, kind) = fits.max_by_key(|(name, _)| name.len()).ok_or(Problem)?;
        let rest = unquoted(&word[name.len()..]);
        let on = if is_on { "on" } else { "off" };
        match *kind {
            Value(_) if rest.is_empty() => Err(Problem),
            Value(option) => self.set(option, &rest),
            Switch(option) => self.set(option, on),
            Both(option, value) => {
                self.set(option, on)?;
                if rest.is_empty() { Ok(()) } else { self.set(value, &rest) }
            }
            Type => {
                self.set("output_to_file", on)?;
                let Some(letter) = rest.chars().next() else { return Ok(()) };
                self.set("output_file_type", &letter.to_string())?;
                match (letter.to_ascii_lowercase(), &rest[letter.len_utf8()..]) {
                    (_, "") => Ok(()),
                    ('n' | 'p', "g" | "G") => self.set("grayscale_output", "on"),
                    (_, bits) if bits.chars().all(|c| c.is_ascii_digit()) => {
                        self.set("bits_per_color", bits)
                    }
                    _ => Err(Problem),
                }
            }
            Ignored => Ok(()),
        }
    }

    /// Reads an INI file, or one section of it: `file[section]`. Its folder plays no part in the paths that it names.
    pub fn take_file(
        &mut self,
        name: &str,
        read: &dyn Fn(&Path) -> Option<String>,
    ) -> Result<(), Problem> {
        let (file, section) = match name.strip_suffix(']').and_then(|name| name.rsplit_once('[')) {
            Some((file, section)) => (file, Some(section)),
            None => (name, None),
        };
        let text = [PathBuf::from(file), PathBuf::from(format!("{file}.ini"))]
            .iter()
            .find_map(|path| read(path))
            .ok_or(Problem)?;
        if self.nesting == MOST_NESTED {
            return Err(Problem);
        }
        self.nesting += 1;
        let taken = self.take_text(&text, section, read);
        self.nesting -= 1;
        taken
    }

    /// Reads the text of an INI file: what stands before all sections, and what stands in this one.
    pub fn take_text(
        &mut self,
        text: &str,
        section: Option<&str>,
        read: &dyn Fn(&Path) -> Option<String>,
    ) -> Result<(), Problem> {
        let mut is_meant = true;
        for line in text.lines() {
            if let Some(name) = section_of(line) {
                is_meant = section.is_some_and(|meant| meant.eq_ignore_ascii_case(name));
                continue;
            }
            let line = uncommented(line).trim();
            if !is_meant || line.is_empty() {
                continue;
            }
            let name = line.split('=').next().unwrap_or_default().trim();
            let is_name = name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_');
            match line.split_once('=').filter(|_| is_name) {
                Some((name, value)) if name.trim().eq_ignore_ascii_case("include_ini") => {
                    self.take_file(&unquoted(value.trim()), read)?;
                }
                Some((name, value)) => self.set(name.trim(), &unquoted(value.trim()))?,
                None => self.take(&[line.to_owned()], read)?,
            }
        }
        Ok(())
    }
}

/// Returns the name of the section that a line of an INI file begins.
pub fn section_of(line: &str) -> Option<&str> {
    let line = uncommented(line).trim();
    line.strip_prefix('[')?.strip_suffix(']').map(str::trim)
}

/// Returns the line without its comment: what follows a `;` or `#` outside of quotes.
fn uncommented(line: &str) -> &str {
    let mut quote = None;
    for (at, c) in line.char_indices() {
        match (quote, c) {
            (None, '"' | '\'') => quote = Some(c),
            (Some(open), c) if open == c => quote = None,
            (None, ';') => return &line[..at],
            (None, '#') if at == 0 => return "",
            _ => {}
        }
    }
    line
}

/// Returns the text without the quotes around it, or around its parts.
fn unquoted(text: &str) -> String {
    text.chars().filter(|c| !matches!(c, '"' | '\'')).collect()
}

/// Splits a word at blanks outside of quotes, if an option follows.
fn parts(word: &str) -> Vec<String> {
    let (mut parts, mut part, mut quote) = (Vec::new(), String::new(), None);
    let mut rest = word.chars().peekable();
    while let Some(c) = rest.next() {
        match (quote, c) {
            (None, '"' | '\'') => quote = Some(c),
            (Some(open), c) if open == c => quote = None,
            (None, c) if c.is_whitespace() && matches!(rest.peek(), Some('+' | '-')) => {
                parts.push(std::mem::take(&mut part).trim().to_owned());
                continue;
            }
            _ => {}
        }
        part.push(c);
    }
    parts.push(part.trim().to_owned());
    parts.retain(|part| !part.is_empty());
    parts
}

#[cfg(test)]
mod tests {
    use lucarne::film::Depth;
    use lucarne::picture::Format;

    use super::*;

    fn taken(words: &[&str]) -> Result<Settings, Problem> {
        let mut settings = Settings::default();
        let words: Vec<String> = words.iter().map(|&word| word.to_owned()).collect();
        let read = |path: &Path| {
            let text = match path.to_str()? {
                "big.ini" => "; a comment\nWidth=1000 ; px\n[small]\nHeight=10\n[Other]\n+UA -V\n",
                "endless.ini" => "Include_Ini=endless\n",
                "nested.ini" => "Include_Ini=big\nOutput_File_Name=\"a;b.png\"\n",
                _ => return None,
            };
            Some(text.to_owned())
        };
        settings.take(&words, &read).map(|()| settings)
    }

    /// The options of POV-Ray's manual, as the program takes them.
    const MANUAL: &str = "\
        Clock=3.45 +K3.45 -K3.45 Initial_Frame=1 Final_Frame=2 +KFI1 +KFF2 +KI0 +KF1 +SF2 +EF2 \
        +SF0.5 +STP2 Frame_Step=2 -STP2 +KC -KC +UF -UF +UO Field_Render=on Odd_Field=on +MI100 \
        Max_Image_Buffer_Memory=100 +X -X +X10 Test_Abort=on Test_Abort_Count=5 +C -C \
        Continue_Trace=off +GIfoo.ini -GIfoo.ini Create_Ini=foo.ini +D +D0 -D0 +DGA +Dxy \
        Video_Mode=0 Palette=3 Display=off Display_Gamma=2.2 Display_Gamma=sRGB Pause_When_Done=off \
        +P -P Verbose=off +UD -UD Draw_Vistas=on +SP8 +EP4 Preview_Start_Size=8 +B -B +BS8 +BM1 +BM2 \
        Bounding_Method=2 BSP_MaxDepth=20 BSP_ChildAccessCost=1.5 BSP_IsectCost=1.5 \
        BSP_MissChance=0.2 Dither=on Dither_Method=FS +THfs -THfs +TH +THB2 Compression=80 +FJ80 +FJ \
        File_Gamma=2.2 +FN8 Declare=RAD=0 Declare=RAD +HIx.inc Include_Header=x.inc +L. \
        Library_Path=. +MV3.5 Version=3.6 Pre_Scene_Command=true Post_Frame_Command=true \
        Pre_Scene_Return=S User_Abort_Return=-S Fatal_Error_Command=true Append_File=true +GP -GP \
        +GDd.txt -GDd.txt +GA -GA -GAall.txt +GAall.txt Debug_File=true Debug_File=false \
        All_File=x.txt +WL3 Warning_Level=5 +WT4 +WT0 Work_Threads=2 Render_Block_Size=16 +RP3 \
        Render_Pattern=2 +RS2 Render_Block_Step=2 +Q12 +Q-1 Quality=20 +MB -MB +MB5 Light_Buffer=on \
        +UL +UV -UV Vista_Buffer=off +UR -UR +SU -SU Split_Unions=on Remove_Bounds=off +A -A +A0.1 \
        -A0.1 +AM1 +AM2 +AM3 +AM4 +AM0 Sampling_Method=3 +AG2.5 Antialias_Gamma=2.5 \
        Antialias_Depth=3 +R4 +R0 +R12 +J +J0.5 -J -J0.5 Jitter_Amount=0.2 +HR -HR \
        High_Reproducibility=on +RFI +RFO +RVP -RVP Radiosity_Vain_Pretrace=off \
        Radiosity_From_File=off Radiosity_To_File=on +RTR Real_Time_Raytracing=off \
        Real_Time_Raytracing=on +UA +V -V +SC0 +SC6 +EC3 Start_Row=0.5 +SR0.5 +ER0.25 +F -F -FN \
        Output_to_File=off Output_Alpha=on Output_Alpha=2 +Ia.pov Verbose=perhaps \
        Debug_Console=perhaps Output_File_Type=N16 Output_File_Type=Ng Output_File_Type=PNG \
        All_File=true Fatal_File=true Render_File=true Statistic_File=true Warning_File=true \
        All_File=false Debug_File=off -GD +GD +ER6 +SR6 +GS +GSs.txt Buffer_Output=on Buffer_Size=10 \
        BSP_BaseCost=1 Output_File_Name=a +Oa End_Row=0.9 End_Column=9 Start_Column=1 \
        Subset_Start_Frame=1 Subset_End_Frame=0.9 Initial_Clock=0 Final_Clock=1 Cyclic_Animation=on \
        Preview_End_Size=8 Radiosity_File_Name=r.rca Bounding=on Bounding_Threshold=3 Antialias=on \
        Antialias_Threshold=0.1 Jitter=on Height=9 Bits_Per_Color=16 Grayscale_Output=on \
        Pre_Frame_Command=a Post_Scene_Command=a User_Abort_Command=a Pre_Frame_Return=I \
        Post_Scene_Return=Q Post_Frame_Return=U Fatal_Error_Return=F Debug_Console=on \
        Fatal_Console=on Render_Console=on Statistic_Console=on Warning_Console=on All_Console=on";

    #[test]
    fn every_option_of_the_manual_is_known() {
        for word in MANUAL.split_whitespace() {
            assert!(taken(&[word]).is_ok(), "{word}");
        }
    }

    #[test]
    fn switches_are_read_in_any_case_and_signs_matter_for_switches_alone() {
        let settings = taken(&["+Ia.pov", "-w640", "+H480", "+a0.1", "+R2", "-AM2", "+FJ", "+wt3"]);
        let settings = settings.expect("known");
        assert_eq!(settings.input.as_deref(), Some("a.pov"));
        assert_eq!((settings.width, settings.height, settings.threads), (640, 480, Some(3)));
        assert_eq!(settings.format, Format::Jpeg);
        let sizes = taken(&["a.pov", "Width=3", "+KFF12", "-D", "+Q11", "-P", "+Lsome/folder"]);
        let sizes = sizes.expect("known");
        assert_eq!(sizes.frames().map(|range| range.frames), Some((1, 12)));
        assert_eq!((sizes.width, sizes.quality), (3, 11));
        assert_eq!(sizes.folders, [PathBuf::from("some/folder")]);
        assert!(!taken(&["+F", "-F"]).expect("known").writes);
        assert_eq!(taken(&["+FN16"]).expect("known").bits, 16);
        assert_eq!(taken(&["+FPg"]).expect("known").depth(), Depth::Sixteen);
        assert!(!taken(&["+FN", "+FTg"]).is_ok_and(|settings| settings.is_supported()));
        assert_eq!(
            taken(&["+STP2", "+KFF5"]).expect("known").frames().map(|range| range.step),
            Some(2)
        );
    }

    #[test]
    fn a_word_may_hold_several_options_and_quotes_hold_blanks() {
        let settings =
            taken(&["+W20 +H30", "+I\"my scene.pov\"", "+O'out +x.png'"]).expect("known");
        assert_eq!((settings.width, settings.height), (20, 30));
        assert_eq!(settings.input.as_deref(), Some("my scene.pov"));
        assert_eq!(settings.output.as_deref(), Some("out +x.png"));
    }

    #[test]
    fn ini_files_have_comments_sections_and_other_files() {
        let height = Settings::default().height;
        let settings = taken(&["big"]).expect("read");
        assert_eq!((settings.width, settings.height, settings.alpha), (1000, height, false));
        assert_eq!(taken(&["big.ini[SMALL]"]).expect("read").height, 10);
        let other = taken(&["big[other]"]).expect("read");
        assert!(other.alpha && !other.verbose);
        let nested = taken(&["nested"]).expect("read");
        assert_eq!((nested.width, nested.output.as_deref()), (1000, Some("a;b.png")));
    }

    #[test]
    fn what_is_unknown_is_a_problem() {
        for word in
            ["+Zfoo", "none.ini", "endless.ini", "+W", "+O", "+FNx", "+FS", "+?", "Widht=3", "+"]
        {
            assert_eq!(taken(&[word]), Err(Problem), "{word}");
        }
    }
}
