// Written by tests/hex/make_cut_table.cpp.
#include "cut_table_rows.hpp"

namespace hexfield::hex {

const char* const cut_table_rows = R"(10 bcd,adec,abefd,acfgeb,bdghfc,cehigd,dfijhe,egjif,fhjg,gih|9|6|cde cegf cehf def
10 bcd,adec,abefgd,acgheb,bdhfc,cehig,cfijhd,dgjife,fhjg,gih|7|5|cdhf defg
10 bcd,adec,abefgd,acgheb,bdhfc,cehijg,cfjhd,dgjife,fhj,fihg|7|4|acgd bcgd cdhf cedg cehg
10 bcd,adec,abefgd,acgheb,bdhifc,ceig,cfijhd,dgjie,ehjgf,gih|7|5|cehg defg deig efgh fghi fgji
10 bcd,adec,abefgd,acgheb,bdhifc,ceihjg,cfjhd,dgjfie,ehf,fhg|7|4|acgd bcgd cedg cehg efgh efjh fghi fihj
10 bcd,adec,abefgd,acgheb,bdhifc,ceijg,cfjhd,dgjie,ehjf,fihg|5|3|acgd bcgd cedg cehg efgh
10 bcd,adec,abefgd,acgheb,bdhifc,ceijhg,cfhd,dgfjie,ehjf,fih|7|4|acgd bcgd cedg cehg
10 bcd,adefc,abfgd,acgeb,bdghif,beijgc,cfjhed,egji,ehjf,fihg|7|5|bcge begf beif efgh
10 bcd,adefc,abfghd,achieb,bdif,beijgc,cfjh,cgjid,dhjfe,fihg|5|4|abed bcde cdef cdif cfih
10 bcd,adefc,abfghd,achieb,bdif,beijgc,cfjih,cgid,dhgjfe,fig|7|5|abed bcde cdef cdif
10 bcd,adefc,abfghd,achieb,bdigjf,bejgc,cfjeih,cgid,dhge,egf|7|5|abfc bcge bdcf cdeg
10 bcd,adefc,abfghd,achieb,bdihjf,bejgc,cfjh,cgjeid,dhe,ehgf|7|5|abehd abeid abfc ached achid bcdie bche bchid bdcf bdhe bdie cdef cfeh
10 bcd,adefc,abfghd,achieb,bdijf,bejgc,cfjh,cgjid,dhje,eihgf|6|5|abed achd bcde bchd bchje cdef cdejg cfedh cfeih
10 bcd,adefc,abfghd,achieb,bdijf,bejgc,cfjih,cgid,dhgje,eigf|6|5|abed bcde bcgie cdef cdejg cfeih
10 bcd,adefgc,abgfhd,achieb,bdihjf,bejhcg,bfc,cfjeid,dhe,ehf|7|4|abfc abgc bdcf bdhf
10 bcd,adefgc,abghd,acheb,bdhif,beijg,bfjhc,cgjied,ehjf,fihg|5|4|abed bcde bche behg efgh
10 bcd,adefgc,abghd,acheb,bdhif,beijg,bfjihc,cgied,ehgjf,fig|7|5|abed achd bcde bchd bche bdhg behg
10 bcd,adefgc,abghd,acheb,bdhijf,bejg,bfjihc,cgied,ehgj,eigf|5|3|achd bchd bche behg beig efgh
10 bcd,adefgc,abghid,acijeb,bdjf,bejhg,bfhc,cgfji,chjd,dihfe|6|5|abed bcde bcdjf bchje
10 bcd,adefgc,abghid,acijeb,bdjigf,beg,bfeihc,cgi,chgejd,die|11|8|abegc abeghc abejd bcie
10 bcde,aefc,abfgd,acghie,adifb,beijgc,cfjhd,dgji,dhjfe,fihg|3|2|cdef cdif
10 bcde,aefc,abfgd,acghie,adifb,beijgc,cfjihd,dgi,dhgjfe,fig|5|3|cdef cdif dgfi dgji ghij
10 bcde,aefc,abfgd,acghie,adijfb,bejhgc,cfhd,dgfji,dhje,eihf|3|2|cdef defg
10 bcde,aefc,abfghd,ache,adhifb,beijgc,cfjh,cgjied,ehjf,fihg|3|1|bche cfeh
10 bcde,aefc,abfghd,achie,adijfb,bejgc,cfjh,cgjid,dhje,eihgf|4|3|achje cdef cdejg cdijf
10 bcde,aefgc,abgfhd,achije,adjfb,bejhcg,bfc,cfjid,dhj,dihfe|7|5|abfc abgc acfe bcfe befg cdef cdjf defh dejh deji
10 bcde,aefgc,abghd,achie,adifb,beijg,bfjhc,cgjid,dhjfe,fihg|5|5|abfjhd bcdif
10 bcde,aefgc,abghid,acie,adijfb,bejg,bfjihc,cgi,chgjed,eigf|5|4|bchg bcie bcig
10 bcde,aefghc,abhid,acije,adjfb,bejg,bfjih,bgic,chgjd,digfe|4|4|bcdjg
10 bcdefg,aghijc,abjd,acje,adjif,aeihg,afhb,bgfi,bhfej,biedc|3|3|abie abif
11 bcd,adec,abefd,acfgeb,bdghfc,cehigd,dfijhe,egjkif,fhkjg,gikh,hji|11|7|acfigd cde cdgif cegf def efg
11 bcd,adec,abefgd,acgheb,bdhfc,cehijg,cfjkhd,dgkife,fhkj,fikg,gjih|8|5|cdhf cehg efgh efih fghi fgkh
11 bcd,adec,abefgd,acgheb,bdhifc,ceig,cfijhd,dgjkie,ehkjgf,gikh,hji|8|5|cehg defg
11 bcd,adec,abefgd,acgheb,bdhifc,ceijg,cfjhd,dgjkie,ehkjf,fikhg,hji|8|5|acgd bcgd cedg cehg defg efgh efjh fghi fihj fikj ghij ghkj
11 bcd,adec,abefgd,acgheb,bdhifc,ceijg,cfjkhd,dgkie,ehkjf,fikg,gjih|6|4|cehg efgh fghi
11 bcd,adec,abefgd,acgheb,bdhifc,ceijg,cfjkhd,dgkjie,ehjf,fihkg,gjh|8|5|cehg defg efgh fghi fghj fgkj ghij hijk
11 bcd,adec,abefgd,acgheb,bdhifc,ceijkg,cfkhd,dgkjie,ehjf,fihk,fjhg|6|3|acgd bcgd cedg cehg efgh efkh fghi
11 bcd,adefc,abfgd,acgeb,bdghif,beijgc,cfjhed,egjki,ehkjf,fikhg,hji|10|7|bcge begf beif
11 bcd,adefc,abfgd,acgheb,bdhijf,bejgc,cfjkhd,dgkjie,ehj,eihkgf,gjh|8|5|abfc bdcf bdgf defg dejg efgh ehgj ehkj hijk
11 bcd,adefc,abfghd,achieb,bdif,beijgc,cfjh,cgjkid,dhkjfe,fikhg,hji|8|6|abed bcde cdef cdif
11 bcd,adefc,abfghd,achieb,bdif,beijgc,cfjkh,cgkid,dhkjfe,fikg,gjih|6|5|abed bcde cdef cdif cfih fghi
11 bcd,adefc,abfghd,achieb,bdijf,bejgc,cfjikh,cgkid,dhkgje,eigf,gih|9|7|abed bcde bcgie cdef cdejg cdig cfeih
11 bcd,adefc,abfghd,achieb,bdijf,bejgc,cfjkh,cgkid,dhkje,eikgf,gjih|8|6|abed achd bcde bcgjid bcgkie bchd bchkje cdef cdejg cdijg cfedh cfeih cfjih efghi
11 bcd,adefc,abfghd,achieb,bdijf,bejgc,cfjkih,cgid,dhgkje,eikgf,gji|9|7|abed bcde bcgie cdef cfeih
11 bcd,adefc,abfghd,achieb,bdijf,bejkgc,cfkh,cgkid,dhkje,eikf,fjihg|7|6|abed bcde cdef cdikf cfeih defkh
11 bcd,adefc,abfghd,achieb,bdijf,bejkgc,cfkh,cgkjid,dhje,eihkf,fjhg|7|5|abed bcde bchje bdhjf cdef cdijf cfeih cfjh defgh defkh
11 bcd,adefc,abfghd,achieb,bdijf,bejkgc,cfkih,cgid,dhgkje,eikf,fjig|7|5|abed bcde bcgie bdigf cdef cdijf cdikf cfeih defgh efgi
11 bcd,adefc,abfghd,achieb,bdijf,bejkgc,cfkjh,cgjid,dhje,eihgkf,fjg|9|7|abed achd bcde bchd bchje bdhjf cdef cdijf cfedh cfeih
11 bcd,adefc,abfghd,achieb,bdijkf,bekjgc,cfjh,cgjid,dhje,eihgfk,ejf|9|7|achd bchd bchje bejf bekf cdef cdejf cdejg cfedh cfeih cfejh efgj eijk
11 bcd,adefgc,abghd,acheb,bdhif,beijg,bfjkhc,cgkied,ehkjf,fikg,gjih|6|5|abed bcde bche bdhg behg efgh fghi
11 bcd,adefgc,abghd,acheb,bdhif,beijkg,bfkhc,cgkied,ehkjf,fik,fjihg|8|6|abed bcde bche behg
11 bcd,adefgc,abghd,acheb,bdhijf,bejg,bfjkhc,cgkied,ehkj,eikgf,gjih|6|4|bche behg efgh ehgj
11 bcd,adefgc,abghd,acheb,bdhijf,bejkg,bfkihc,cgied,ehgkj,eikf,fjig|6|4|achd bchd bche behg beig efgh efgi
11 bcd,adefgc,abghid,acijeb,bdjf,bejkg,bfkhc,cgki,chkjd,dikfe,fjihg|8|6|abed abgc bcde bcdjf bchkjd bchkje bcid bcijf bcikf bdikf bdikg bedikg bejicg bejihg cgfji
11 bcd,adefgc,abghid,acijeb,bdjf,bejkg,bfkhc,cgkji,chjd,dihkfe,fjhg|7|5|abgc bchjf bdcg bdjhg
11 bcd,adefgc,abghid,acijeb,bdjf,bejkhg,bfhc,cgfkji,chjd,dihkfe,fjh|9|7|abed bcde bcdjf bchje
11 bcd,adefgc,abghid,acijeb,bdjkf,bekg,bfkhc,cgki,chkjd,dike,ejihgf|7|5|abed bcde bcike
11 bcde,aefc,abfgd,acghe,adhifb,beijgc,cfjkhd,dgkie,ehkjf,fikg,gjih|4|4|cdef defg
11 bcde,aefc,abfgd,acghie,adijfb,bejkgc,cfkhd,dgki,dhkje,eikf,fjihg|5|4|cdef cdikf defg defkh dejkg dgfji efghi
11 bcde,aefc,abfghd,ache,adhifb,beijgc,cfjikh,cgkied,ehkgjf,fig,gih|6|3|bche cfeh cfih fghi fgki gjik
11 bcde,aefc,abfghd,achie,adijfb,bejgc,cfjkh,cgkid,dhkje,eikgf,gjih|6|5|acgkie cdef cdejg cdijf cdijg
11 bcde,aefc,abfghd,achie,adijfb,bejkgc,cfkh,cgkid,dhkje,eikf,fjihg|5|4|cdef cdikf cfeih
11 bcde,aefc,abfghd,achie,adijfb,bejkgc,cfkh,cgkjid,dhje,eihkf,fjhg|5|3|achje bchje cdef cdijf cfeih
11 bcde,aefc,abfghd,achije,adjkfb,bekigc,cfih,cgid,dhgfkj,dike,ejif|4|3|cdef
11 bcde,aefgc,abgd,acghe,adhifb,beijkg,bfkhdc,dgkjie,ehjf,fihk,fjhg|4|2|bedg behg efgh efkh
11 bcde,aefgc,abgd,acghie,adijfb,bejhkg,bfkhdc,dgkfji,dhje,eihf,fhg|6|4|bedg defg defh
11 bcde,aefgc,abgfhd,achie,adijfb,bejhcg,bfc,cfjkid,dhkje,eikhf,hji|8|6|abfc abgc acfe cdef defh dejh dhji dhki efhi
11 bcde,aefgc,abghid,acihje,adjkfb,bekjg,bfjhc,cgjdi,chd,dhgfke,ejf|9|7|abgjd acgje bcdjf bchje bedhg bejf bejg bekf cdefg cdhg cdjg cghi efgj fgjk
11 bcde,aefghc,abhid,acije,adjfb,bejg,bfjkh,bgkic,chkjd,dikgfe,gjih|6|5|abhkjd achgje bcdjf bcdjg bcije bedih
11 bcde,aefghc,abhid,acije,adjfb,bejkg,bfkh,bgkic,chkjd,dikfe,fjihg|6|5|abfkid bcije cdefkh
11 bcdef,afegc,abghid,acihje,adjgbf,aeb,bejkhc,cgkjdi,chd,dhkge,gjh|10|8|acge bcde cdeg cdhkg cdjg cdjh cdjkh cgjhi cgkhi degh dihgj dihj dihkj
11 bcdef,afghc,abhd,achije,adjigf,aegb,bfeikh,bgkidc,dhkgej,die,gih|9|7|abgid achge adhge adie adje degh degki dhkij
11 bcdef,afghc,abhd,achije,adjkgf,aegb,bfekjh,bgjidc,dhj,dihgke,ejg|9|7|abgjd achge degh degji dekji
11 bcdefg,aghijc,abjd,acjke,adkf,aekhg,afhb,bgfki,bhkj,bikdc,djihfe|5|4|abhkd
12 bcd,adec,abefd,acfgeb,bdghfc,cehigd,dfijhe,egjkif,fhkljg,gilkh,hjli,ikj|13|9|cde cegf def efg
12 bcd,adec,abefgd,acgheb,bdhfc,cehijg,cfjkhd,dgkife,fhklj,filkg,gjlih,ikj|11|7|cdhf cehg efgh efih fghi fgkh fgki fhkj
12 bcd,adec,abefgd,acgheb,bdhifc,ceijg,cfjhd,dgjkie,ehkljf,filkhg,hjli,ikj|9|5|acgd bcgd cedg cehg defg efgh
12 bcd,adec,abefgd,acgheb,bdhifc,ceijg,cfjkhd,dgkie,ehkljf,filkg,gjlih,ikj|9|6|cehg efgh fghi fgki fikj filj
12 bcd,adec,abefgd,acgheb,bdhifc,ceijg,cfjkhd,dgklie,ehljf,filkg,gjlh,hkji|7|5|cehg defg efgh fghi ghij
12 bcd,adec,abefgd,acgheb,bdhifc,ceijg,cfjkhd,dgklie,ehlkjf,fikg,gjilh,hki|9|6|cehg defg efgh fghi ghij hijk ijkl
12 bcd,adec,abefgd,acgheb,bdhifc,ceijkg,cfkhd,dgklie,ehljf,filk,fjlhg,hkji|7|4|acgd bcgd cedg cehg efgh efkh fghi fihk
12 bcd,adec,abefgd,acgheb,bdhifc,ceijkg,cfkhd,dgklie,ehlkjf,fik,fjilhg,hki|9|5|acgd bcgd cedg cehg efgh efkh fghi fihk filk ijkl
12 bcd,adec,abefgd,acgheb,bdhifc,ceijkg,cfkjhd,dgjlie,ehljf,filhgk,fjg,hji|11|8|cehg defg efgh efjh fghi fghlj fgji fgjli fihjk fijk filjk ghijk ghljk
12 bcd,adec,abefgd,acgheb,bdhifc,ceijkg,cfklhd,dgljie,ehjf,fihlk,fjlg,gkjh|7|4|cehg efgh fghi fghj
12 bcd,adefc,abfgd,acgheb,bdhijf,bejkgc,cfklhd,dgljie,ehj,eihlkf,fjlg,gkjh|9|7|bdgf cdef defg efgh fghj
12 bcd,adefc,abfghd,achieb,bdif,beijgc,cfjkh,cgklid,dhljfe,filkg,gjlh,hkji|7|6|abed bcde cdef cdif cfih fghi ghij
12 bcd,adefc,abfghd,achieb,bdif,beijgc,cfjklh,cglkid,dhkjfe,fikg,gjihl,gkh|9|7|abed bcde cdef cdif cfih
12 bcd,adefc,abfghd,achieb,bdijf,bejgc,cfjkh,cgkid,dhklje,eilkgf,gjlih,ikj|11|8|abed abfc achd bcde bcgjid bcgkie bchd bchkje bdcf bdikgf cdef cdejg cdijf cfedh cfeih defgh
12 bcd,adefc,abfghd,achieb,bdijf,bejgc,cfjkh,cgklid,dhlje,eilkgf,gjlh,hkji|9|7|abed bcde bcgjid bchkje bchlje cdef cdejg cdijg cfeih cfjih efghi ghij
12 bcd,adefc,abfghd,achieb,bdijf,bejgc,cfjkh,cgklid,dhlkje,eikgf,gjilh,hki|11|8|abed abfc bcde bcgjid bcgkie bchkje bdcf bdhkjf cdef cdejg cdijf cdijg defgh
12 bcd,adefc,abfghd,achieb,bdijf,bejgc,cfjklh,cglid,dhlkje,eikgf,gjil,gkih|9|6|abed achd bcde bcgjid bcgkie bcglie bchd cdef cdejg cdijg cfedh cfeih cfjih efghi ghij
12 bcd,adefc,abfghd,achieb,bdijf,bejkgc,cfkh,cgklid,dhlje,eilkf,fjlhg,hkji|9|7|abed bcde bchkje bdhljf cdef cdijf cdilkf cfeih cfjih defgh defkh dejkh efkhi fghij
12 bcd,adefc,abfghd,achieb,bdijf,bejkgc,cfkh,cgklid,dhlkje,eikf,fjilhg,hki|10|8|abed bcde cdef cdikf cfeih defkh
12 bcd,adefc,abfghd,achieb,bdijf,bejkgc,cfkjlh,cglid,dhlje,eilgkf,fjg,gjih|11|8|abed achd bcde bcgjid bcglie bchd bchlje bdhgjf bdhljf bdijgf bdilgf cdef cdejg cdejlg cdijf cdijg cfedh cfeih cfejlh cfjih defgh dejgh efghi efgj efkj fghij fglj gkjl
12 bcd,adefc,abfghd,achieb,bdijf,bejkgc,cfklh,cglid,dhlje,eilkf,fjlg,gkjih|9|7|abed achd bcde bchd bdhljf bdilgf cdef cdejlg cdilkf cfeih defklh fghij
12 bcd,adefc,abfghd,achieb,bdijf,bejkgc,cfklh,cglid,dhlkje,eikf,fjilg,gkih|9|7|abed achd bcde bcgkie bchd bdilgf cdef cdijf cdikf cdikg cfedh cfeih cfkih defgh defklh efghi fghij
12 bcd,adefc,abfghd,achieb,bdijf,bejkgc,cfklh,cgljid,dhje,eihlkf,fjlg,gkjh|8|6|abed bcde bchje bdhjf cdef cdijf cfeih cfjh defgh fghj
12 bcd,adefc,abfghd,achieb,bdijf,bejkgc,cfklh,cglkid,dhkje,eikf,fjihlg,gkh|10|8|abed bcde cdef cdikf cfeih cfkh defkh
12 bcd,adefc,abfghd,achieb,bdijf,bejkgc,cfklih,cgid,dhglje,eilkf,fjlg,gkji|8|6|abed bcde bcgie bdigf cdef cdijf cfeih defgh efgi fgij
12 bcd,adefc,abfghd,achieb,bdijkf,bekjgc,cfjilh,cglid,dhlgje,eigfk,ejf,gih|12|9|bcgie cdef
12 bcd,adefc,abfghd,achieb,bdijkf,bekjgc,cfjlh,cglid,dhlje,eilgfk,ejf,gjih|11|7|achd bcgjid bcgjie bcglie bchd bchlje beihgf bejf bekf cdef cdejf cdejg cdijg cfedh cfeih cfejlh cfjedh cfjih efghi efgj eijk
12 bcd,adefc,abfghd,achieb,bdijkf,bekjgc,cfjlih,cgid,dhglje,eilgfk,ejf,gji|12|9|bcgie cdef cdejg cfeih efgi efglj eigjk eiljk
12 bcd,adefc,abfghd,achieb,bdijkf,beklgc,cflh,cglid,dhlje,eilk,ejlf,fkjihg|8|6|cdef cdilf cfeih deflh efli
12 bcd,adefc,abfghd,achieb,bdijkf,beklgc,cflh,cgljid,dhje,eihlk,ejlf,fkjhg|8|6|cdef cfejh
12 bcd,adefc,abfghd,achieb,bdijkf,beklgc,cflh,cglkid,dhkje,eik,ejihlf,fkhg|10|7|bchke bdhkf cdef cfkh defgh
12 bcd,adefc,abfghd,achieb,bdijkf,beklgc,cflih,cgid,dhglje,eilk,ejlf,fkjig|8|6|bcgie bdigf cdef cdilf cfeih defgh efgi efli
12 bcd,adefc,abfghd,achieb,bdijkf,beklgc,cflkih,cgid,dhgkje,eik,ejiglf,fkg|12|9|bcgie cdef cdekg cfeih efgi efgkj eflkj eiglk gijkl
12 bcd,adefgc,abgfhd,achieb,bdijkf,bekhcg,bfc,cfklid,dhlkje,eik,ejilhf,hki|9|5|abfc abgc bdcf bdhf defh
12 bcd,adefgc,abghd,acheb,bdhif,beijg,bfjkhc,cgkied,ehkljf,filkg,gjlih,ikj|9|7|abed bcde bche bdhg behg efgh
12 bcd,adefgc,abghd,acheb,bdhif,beijkg,bfklhc,cglied,ehljf,filk,fjlg,gkjih|7|6|abed bcde bche bdhg behg efgh fghi fgli
12 bcd,adefgc,abghd,acheb,bdhijf,bejg,bfjkhc,cgkied,ehklj,eilkgf,gjlih,ikj|9|6|bche behg efgh
12 bcd,adefgc,abghd,acheb,bdhijf,bejkg,bfkihc,cgied,ehgklj,eilkf,fjlig,ikj|9|6|achd bchd bche behg beig efgh
12 bcd,adefgc,abghd,acheb,bdhijf,bejkg,bfklhc,cglied,ehlj,eilkf,fjlg,gkjih|8|6|bche bdhg behg bejlg efgh efgli efklh ehgkj fghij
12 bcd,adefgc,abghd,acheb,bdhijf,bejklg,bflihc,cgied,ehglj,eilkf,fjl,fkjig|9|6|achd bchd bche behg beig
12 bcd,adefgc,abghd,acheb,bdhijf,bejklg,bflihc,cgied,ehglkj,eikf,fjil,fkig|7|4|achd bchd bche behg beig efgh efgi efli
12 bcd,adefgc,abghid,acijeb,bdjf,bejkg,bfkhc,cgkli,chljd,dilkfe,fjlhg,hkji|9|7|abed abgc acid bcde bchkjd bchkje bchljf bcid bdcg bdihkf bdjlhg bejihg cdjfg cgkji
12 bcd,adefgc,abghid,acijeb,bdjkf,bekg,bfkhc,cgkli,chljd,dilke,ejlhgf,hkji|9|6|abed acid bcde bchkjd bcid bcijkf bcilke bejihg cdekg cdjkh cgkedi
12 bcd,adefgc,abghid,acijeb,bdjkf,bekg,bfklhc,cgli,chljd,dilke,ejlgf,gkjih|9|7|abed bcde bcilke bdjkg bedilg bejihg defgli
12 bcde,aefc,abfd,acfghe,adhifb,beigdc,dfijkh,dgklie,ehljgf,gilk,gjlh,hkji|9|6|adfe deig
12 bcde,aefc,abfgd,acghe,adhifb,beijgc,cfjkhd,dgklie,ehljf,filkg,gjlh,hkji|5|5|cdef defg efgh
12 bcde,aefc,abfgd,acghie,adifb,beijgc,cfjkhd,dgkjli,dhljfe,filhkg,gjh,hji|7|4|cdef cdif dgfi dgji ghij ghlj hkjl
12 bcde,aefc,abfgd,acghie,adifb,beijgc,cfjkhd,dgkli,dhljfe,filkg,gjlh,hkji|5|3|cdef cdif dgfi
12 bcde,aefc,abfgd,acghie,adijfb,bejkgc,cfkhd,dgkli,dhlje,eilkf,fjlhg,hkji|7|6|cdef cdhljf defg defkh dejkg dejkh dgfji dgkji
12 bcde,aefc,abfgd,acghie,adijfb,bejkgc,cfklhd,dgli,dhlje,eilkf,fjlg,gkjih|6|5|cdef defg dejlg dgfji
12 bcde,aefc,abfgd,acghie,adijfb,bejkgc,cfklhd,dgli,dhlkje,eikf,fjilg,gkih|6|4|cdef cdikf defg dejkg dgfji dgki efghi efgli
12 bcde,aefc,abfghd,ache,adhifb,beijgc,cfjklh,cglied,ehlkjf,fikg,gjil,gkih|5|2|bche cfeh cfih
12 bcde,aefc,abfghd,achie,adijfb,bejgc,cfjkh,cgklid,dhlje,eilkgf,gjlh,hkji|7|5|achkje achlje cdef cdejg cdijf
12 bcde,aefc,abfghd,achie,adijfb,bejkgc,cfkh,cgklid,dhlje,eilkf,fjlhg,hkji|7|5|achkje bchkje cdef cdijf cdilkf cfeih cfjih defgh defkh dejkh efkhi fghij
12 bcde,aefc,abfghd,achie,adijfb,bejkgc,cfkjlh,cglid,dhlje,eilgkf,fjg,gjih|9|6|acglie bcglie cdef cdejg cdejlg cdijf cdijg cfeih cfjih fghij fglj gkjl
12 bcde,aefc,abfghd,achie,adijfb,bejkgc,cfklh,cglid,dhlje,eilkf,fjlg,gkjih|7|5|cdef cdejlg cdilkf cfeih fghij
12 bcde,aefc,abfghd,achije,adjkfb,beklgc,cflh,cglid,dhlj,dilke,ejlf,fkjihg|6|4|cdef cdjlf
12 bcde,aefc,abfghd,achije,adjkfb,beklgc,cflh,cglid,dhlkj,dike,ejilf,fkihg|7|5|cdef cdeklg cdikf cdilf cfkih dhgfkj
12 bcde,aefc,abfghd,achije,adjkfb,beklgc,cflh,cgljid,dhj,dihlke,ejlf,fkjhg|8|6|cdef cdjlf cfejh dhlj hijl
12 bcde,aefc,abfghd,achije,adjkfb,beklgc,cflh,cglkid,dhkj,dike,ejihlf,fkhg|6|3|achke cdef
12 bcde,aefgc,abgfhd,achije,adjkfb,bekhcg,bfc,cfkid,dhklj,dilke,ejlihf,ikj|9|7|abfc abgc acfe cdef defh dekh deki dhkj hijk hilk
12 bcde,aefgc,abghd,achie,adifb,beijkg,bfkjhc,cgjlid,dhljfe,filhgk,fjg,hji|11|7|abfjhd acgjie bcdif bchie bchif bchjie bfidhg bfihg bfjg bfkg fghi fghlj filjk
12 bcde,aefgc,abghd,achije,adjkfb,bekg,bfklhc,cglid,dhlkj,dike,ejilgf,gkih|7|5|abgkid bchike bedhg cdefg cdekg
12 bcde,aefgc,abghid,acie,adijfb,bejklg,bflkhc,cgki,chkjed,eikf,fjihgl,fkg|8|6|bcie bcikf bfkg bflg cgfei
12 bcde,aefgc,abghid,acihje,adjkfb,bekjlg,bflhc,cgljdi,chd,dhlfke,ejf,fjhg|11|7|abflhd abgljd acgfjd acgfje acghje achd achjfe achlfe acid bcdjf bchde bchje bchjf bedhg bejf bekf
12 bcde,aefgc,abghid,acije,adjkfb,bekjlg,bflihc,cgi,chgljd,dilfke,ejf,fjig|11|7|abflid acgfje acglje bcdilf bcdjf bcdjlf bchg bcig bcije bcijf cgfeji cgfji cgli fkjl
12 bcde,aefgc,abghid,acije,adjkfb,beklg,bflhc,cgli,chljd,dilke,ejlf,fkjihg|7|5|acglje bcdjlf
12 bcde,aefgc,abghid,acijke,adklfb,belkjg,bfjihc,cgi,chgjd,digfk,djfle,ekf|10|8|bcdjf cdefg cdjg cgji fjkl
12 bcde,aefghc,abhid,acije,adjfb,bejkg,bfklh,bglic,chljd,dilkfe,fjlg,gkjih|7|7|bcdjlg
12 bcdef,afghc,abhd,achije,adjf,aejkgb,bfkilh,bglidc,dhlgkj,dikfe,fjig,gih|9|6|abgid abgkjd achijf adhgf adigf bcdikf bfedh bfjdh bfjih bgih bglh defgi dhgfj fghij ghik gkil
12 bcdef,afghc,abhd,achije,adjkgf,aegb,bfeklh,bglidc,dhlj,dilke,ejlg,gkjih|7|5|abgljd achge degh
12 bcdef,afghc,abhd,achije,adjkgf,aegb,bfeklh,bglidc,dhlkj,dike,ejilg,gkih|7|5|abgkid achge degh
12 bcdef,afghc,abhid,acije,adjkf,aekgb,bfklh,bglic,chljd,dilke,ejlgf,gkjih|9|8|abgkjd abgljd
12 bcdefg,aghijc,abjd,acjke,adkf,aeklg,aflhb,bgli,bhlkj,bikdc,djilfe,fkihg|7|6|abhlkd abjkf bgfki
12 bcdefg,aghijc,abjd,acjke,adklf,aelg,aflhb,bgli,bhlkj,bikdc,djile,ekihgf|7|6|abhlkd adjilg
12 bcdefg,aghijc,abjd,acjke,adklf,aelhg,afhb,bgfli,bhlkj,bikdc,djile,ekihf|7|7|abhlkd
12 bcdefg,aghijc,abjkd,acke,adklf,aelg,aflhb,bgli,bhlkj,bikc,cjiled,ekihgf|7|5|abhlkd abike
13 bcd,adec,abefd,acfgeb,bdghfc,cehigd,dfijhe,egjkif,fhkljg,gilmkh,hjmli,ikmj,jlk|15|10|cde cegf def efg fgh
13 bcd,adec,abefgd,acgheb,bdhfc,cehijg,cfjkhd,dgkife,fhklj,filmkg,gjmlih,ikmj,jlk|12|7|cdhf cehg efgh
13 bcd,adec,abefgd,acgheb,bdhfc,cehijg,cfjkhd,dgkife,fhklmj,fimkg,gjmlih,ikm,ilkj|12|8|cdhf cehg defg efgh
13 bcd,adec,abefgd,acgheb,bdhifc,ceijg,cfjkhd,dgkie,ehkljf,filmkg,gjmlih,ikmj,jlk|10|6|cehg efgh
13 bcd,adec,abefgd,acgheb,bdhifc,ceijg,cfjkhd,dgklie,ehljf,filmkg,gjmlh,hkmji,jlk|10|7|cehg defg efgh fghi ghij ghlj hijk ijkl
13 bcd,adec,abefgd,acgheb,bdhifc,ceijg,cfjkhd,dgklie,ehlmjf,fimkg,gjmlh,hkmi,ilkj|8|6|cehg defg efgh fghi ghij hijk
13 bcd,adec,abefgd,acgheb,bdhifc,ceijg,cfjkhd,dgklie,ehlmjf,fimlkg,gjlh,hkjmi,ilj|10|7|cehg defg efgh fghi ghij hijk ijkl
13 bcd,adec,abefgd,acgheb,bdhifc,ceijkg,cfkhd,dgklie,ehljf,filmk,fjmlhg,hkmji,jlk|10|6|bcgd cedg cehg efgh efkh fghi fihk filk ijkl
13 bcd,adec,abefgd,acgheb,bdhifc,ceijkg,cfkhd,dgklie,ehlmjf,fimk,fjmlhg,hkmi,ilkj|8|4|bcgd cedg cehg efgh efkh fghi fihk filk
13 bcd,adec,abefgd,acgheb,bdhifc,ceijkg,cfkhd,dgklie,ehlmjf,fimlk,fjlhg,hkjmi,ilj|10|6|bcgd cedg cehg efgh efkh fghi fihk filk ijkl
13 bcd,adec,abefgd,acgheb,bdhifc,ceijkg,cfklhd,dgljie,ehjf,fihlmk,fjmlg,gkmjh,jlk|10|6|cehg efgh fghi fghj fglj
13 bcd,adec,abefgd,acgheb,bdhifc,ceijkg,cfklhd,dglmie,ehmjf,fimk,fjmlg,gkmh,hlkji|9|6|cehg defg efgh efkmh fghi fghmj fglmi fihlk ghijk
13 bcd,adec,abefgd,acgheb,bdhifc,ceijkg,cfklhd,dglmie,ehmkjf,fik,fjimlg,gkmh,hlki|10|7|cehg defg efgh fghi ghik
13 bcd,adefc,abfgd,acgeb,bdghif,beijgc,cfjhed,egjkli,ehlmjf,fimkhg,hjml,hkmi,ilkj|12|8|bcge begf efjh hijk
13 bcd,adefc,abfgd,acgheb,bdhijf,bejgc,cfjkhd,dgklie,ehlkmj,eimkgf,gjmilh,hki,ikj|10|6|bdcf bdgf defg dejg efgh ehgj ehkj hijk himk ijkl
13 bcd,adefc,abfgd,acgheb,bdhijf,bejkgc,cfklhd,dglie,ehlmj,eimlkf,fjlg,gkjmih,ilj|11|8|bdgf cdef defg dejlg efgh efgli efklh ehgkj ehlj fghij hijl
13 bcd,adefc,abfghd,achieb,bdif,beijgc,cfjklh,cglmid,dhmjfe,fimkg,gjml,gkmh,hlkji|8|7|bcde cdef cdif cfih fghi ghij ghmj
13 bcd,adefc,abfghd,achieb,bdif,beijgc,cfjklh,cglmid,dhmjfe,fimlkg,gjl,gkjmh,hlji|10|8|bcde cdef cdif cfih
13 bcd,adefc,abfghd,achieb,bdijf,bejgc,cfjkh,cgklid,dhlmje,eimkgf,gjmlh,hkmi,ilkj|10|8|bcde bcgjid bchkje bdcf bdhkjf cdef cdejg cdijf cdijg cfeih cfjih defgh dejgh efghi ghij hijk
13 bcd,adefc,abfghd,achieb,bdijf,bejgc,cfjklh,cglid,dhlmje,eimkgf,gjml,gkmih,ilkj|10|7|bcde bcgjid bcglie bchd cdef cdejg cdijg cfedh cfeih cfjih efghi ghij gjil
13 bcd,adefc,abfghd,achieb,bdijf,bejgc,cfjklh,cglkid,dhkmje,eimkgf,gjmihl,gkh,ikj|14|10|bcde bcgjid bcgkie bchkje bdcf bdhkjf bdikgf cdef cdejg cdijf cdijg cdikjf cfeih cfjih defgh defgkh dejgh efghi eihgj eikj ghij ghimk ghkmj gjikl hijkl
13 bcd,adefc,abfghd,achieb,bdijf,bejgc,cfjklh,cglmid,dhmkje,eikgf,gjiml,gkmh,hlki|10|7|bcde bcgjid bcgkie cdef cdejg cdijg cfeih cfjih efghi ghij ghik
13 bcd,adefc,abfghd,achieb,bdijf,bejkgc,cfkh,cgklid,dhlje,eilmkf,fjmlhg,hkmji,jlk|12|9|bcde bchkje bdhljf cdef cdijf cfeih cfjih defgh
13 bcd,adefc,abfghd,achieb,bdijf,bejkgc,cfkh,cgklid,dhlmje,eimkf,fjmlhg,hkmi,ilkj|10|7|bcde bchkje cdef cdijf cdilkf cdimkf cfeih cfjih defgh defkh dejkh efkhi fghij hijk
13 bcd,adefc,abfghd,achieb,bdijf,bejkgc,cfkjlh,cglmid,dhmlje,eilgkf,fjg,gjimh,hli|14|10|bcde bcgjid bcglie bchlje bdhgjf bdhljf bdijgf bdilgf cdef cdejg cdejlg cdijf cdijg cfeih cfeilh cfejlh cfjih defgh dejgh efghi efgj fghij fglj ghij
13 bcd,adefc,abfghd,achieb,bdijf,bejkgc,cfklh,cglid,dhlje,eilmkf,fjmlg,gkmjih,jlk|12|9|bcde bchd bdhljf bdilgf cdef cdejlg cfeih
13 bcd,adefc,abfghd,achieb,bdijf,bejkgc,cfklh,cglid,dhlmje,eimkf,fjmlg,gkmih,ilkj|10|9|bcde cdef cdilkf
13 bcd,adefc,abfghd,achieb,bdijf,bejkgc,cfklh,cglid,dhlmje,eimlkf,fjlg,gkjmih,ilj|12|9|bcde bchd bdhljf bdilgf cdef cdejlg cdiljf cdilkf cfeih defklh eilj fghij hijl ijkl
13 bcd,adefc,abfghd,achieb,bdijf,bejkgc,cfklh,cglmid,dhmje,eimkf,fjmlg,gkmh,hlkji|10|9|bcde cdef defkmh
13 bcd,adefc,abfghd,achieb,bdijf,bejkgc,cfklh,cglmid,dhmje,eimlkf,fjlg,gkjmh,hlji|10|8|bcde bdhljf cdef cfeih fghij
13 bcd,adefc,abfghd,achieb,bdijf,bejkgc,cfklh,cglmid,dhmkje,eikf,fjimlg,gkmh,hlki|10|7|bcde bcgkie cdef cdijf cdikf cdikg cfeih cfkih defgh defklh defkmh efghi fghij ghik
13 bcd,adefc,abfghd,achieb,bdijf,bejkgc,cfklh,cglmid,dhmlje,eilkf,fjlg,gkjimh,hli|12|8|bcde bdhljf bdilgf cdef cdejlg cdilkf cfeih cfeilh defklh fghij ghil hijl
13 bcd,adefc,abfghd,achieb,bdijf,bejkgc,cfklmh,cgmid,dhmje,eimkf,fjmlg,gkm,glkjih|12|9|bcde bchd bdhmjf bdimgf cdef cdejmg cfeih
13 bcd,adefc,abfghd,achieb,bdijf,bejkgc,cfklmh,cgmid,dhmje,eimlkf,fjlg,gkjm,gljih|10|7|bcde bchd bdhmjf bdimgf cdef cdejmg cfeih fghij fgmj
13 bcd,adefc,abfghd,achieb,bdijf,bejkgc,cfklmh,cgmid,dhmlje,eilkf,fjlg,gkjim,glih|10|8|bcde bdilgf cdef cfeih fghij
13 bcd,adefc,abfghd,achieb,bdijf,bejkgc,cfklmh,cgmlid,dhlje,eilkf,fjlg,gkjihm,glh|12|9|bcde bdhljf bdilgf cdef cdejlg cdilkf cfeih defglh defklh fghij ghil ghlk
13 bcd,adefc,abfghd,achieb,bdijf,bejkgc,cfklmh,cgmlid,dhlkje,eikf,fjilg,gkihm,glh|12|9|bcde bcgkie bdilgf cdef cdijf cdikf cdikg cfeih
13 bcd,adefc,abfghd,achieb,bdijkf,bekjgc,cfjlmh,cgmid,dhmlje,eilgfk,ejf,gjim,glih|12|8|bcgjid bcglie bcgmie bchd beihgf bejf cdef cdejf cdejg cdijg cfedh cfeih cfjedh cfjih efghi ghij
13 bcd,adefc,abfghd,achieb,bdijkf,beklgc,cflh,cglid,dhlmje,eimk,ejmlf,fkmihg,ilkj|9|7|cdef cdilf cfeih deflh efli eilk
13 bcd,adefc,abfghd,achieb,bdijkf,beklgc,cflh,cgljid,dhje,eihlmk,ejmlf,fkmjhg,jlk|11|8|cdef cfejh
13 bcd,adefc,abfghd,achieb,bdijkf,beklgc,cflh,cglmid,dhmje,eimk,ejmlf,fkmhg,hlkji|10|8|cdef cfejmh deflh eihlk
13 bcd,adefc,abfghd,achieb,bdijkf,beklgc,cflh,cglmid,dhmje,eimlk,ejlf,fkjmhg,hlji|10|7|bchlje cdef cdijlf cfeih cfejmh defgh deflh dejlh eflhi eihlk
13 bcd,adefc,abfghd,achieb,bdijkf,beklgc,cflh,cglmid,dhmkje,eik,ejimlf,fkmhg,hlki|12|9|bchlke bdhmkf cdef cdikf cdimlf cfeih cfkih defgh deflh deklh eflhi eihlk eimk fghik
13 bcd,adefc,abfghd,achieb,bdijkf,beklgc,cfljmh,cgmid,dhmje,eimglk,ejlf,fkjg,gjih|10|7|bcgmie bchd bdijgf cdef cdejg cdijg cfedh cfeih cfejmh defgh dejgh efghi efgj
13 bcd,adefc,abfghd,achieb,bdijkf,beklgc,cflkjh,cgjmid,dhmje,eimhgk,ejglf,fkg,hji|13|10|cdef cdejg
13 bcd,adefc,abfghd,achieb,bdijkf,beklgc,cflkmh,cgmid,dhmje,eimk,ejmglf,fkg,gkjih|12|9|bcgmie bchd bchmke cdef cdejmg cdekmg cdimkf cfejmh defgh eihgk fgmk
13 bcd,adefc,abfghd,achieb,bdijkf,beklgc,cflmh,cgmid,dhmje,eimk,ejmlf,fkmg,glkjih|10|8|cdef cdekmg cfejmh
13 bcd,adefc,abfghd,achieb,bdijkf,beklgc,cflmh,cgmid,dhmje,eimlk,ejlf,fkjmg,gljih|10|9|cdef cfejmh
13 bcd,adefc,abfghd,achieb,bdijkf,beklgc,cflmih,cgid,dhgmje,eimk,ejmlf,fkmg,glkji|10|7|bcgie cdef cdekmg cfeih efgi efgmj eiglk
13 bcd,adefc,abfghd,achieb,bdijkf,beklgc,cflmih,cgid,dhgmje,eimlk,ejlf,fkjmg,glji|10|7|bcgie cdef cdejlg cfeih efgi efgmj eiglk
13 bcd,adefgc,abghd,acheb,bdhif,beijkg,bfklhc,cglied,ehljf,filmk,fjmlg,gkmjih,jlk|10|8|bcde bche bdhg behg efgh
13 bcd,adefgc,abghd,acheb,bdhif,beijkg,bfklhc,cglied,ehlmjf,fimk,fjmlg,gkmih,ilkj|8|7|bcde bche bdhg behg efgh fghi fgli filk
13 bcd,adefgc,abghd,acheb,bdhijf,bejkg,bfklhc,cglied,ehlmj,eimkf,fjmlg,gkmih,ilkj|10|8|bche behg beimkg efgh efgli efklh efkli ehgkj ehlkj
13 bcd,adefgc,abghd,acheb,bdhijf,bejklg,bflihc,cgied,ehglmj,eimkf,fjml,fkmig,ilkj|8|5|bchd bche behg beig efgh efgi efli fjil
13 bcd,adefgc,abghd,acheb,bdhijf,bejklg,bflmhc,cgmied,ehmj,eimkf,fjml,fkmg,glkjih|9|6|bche bdhg behg bejmg efgh efgmi efkmh eflmh fghij fgmj
13 bcd,adefgc,abghd,acheb,bdhijf,bejklg,bflmhc,cgmied,ehmkj,eikf,fjiml,fkmg,glkih|9|7|bche behg efgh efgmi efkmh
13 bcd,adefgc,abghid,acijeb,bdjf,bejkg,bfklhc,cgli,chlmjd,dimkfe,fjmlg,gkmih,ilkj|10|8|bejilg cdjfg cgkji
13 bcd,adefgc,abghid,acijeb,bdjf,bejkg,bfklhc,cglmi,chmjd,dimkfe,fjmlg,gkmh,hlkji|10|8|bdjmhg
13 bcd,adefgc,abghid,acijeb,bdjf,bejklg,bflhc,cglkmi,chmjd,dimkfe,fjmhl,fkhg,hkji|10|7|bchmjf bcid bdihkf
13 bcd,adefgc,abghid,acijeb,bdjkf,bekg,bfklhc,cglmi,chmjd,dimke,ejmlgf,gkmh,hlkji|10|8|bcid bdimkg dekghi
13 bcd,adefgc,abghid,acijeb,bdjkf,bekg,bfklhc,cglmi,chmjd,dimlke,ejlgf,gkjmh,hlji|10|8|bcid bejihg
13 bcd,adefgc,abghid,acijeb,bdjkf,beklg,bflhc,cglkmi,chmjd,dimke,ejmhlf,fkhg,hkji|10|8|bcid bdihkf
13 bcd,adefgc,abghid,acijeb,bdjkf,beklg,bflhc,cglmi,chmjd,dimke,ejmlf,fkmhg,hlkji|12|9|bcde bcdjkf bchlke bchmje bchmke bchmkf bcimke bedihg bejihg bejmhg bejmlg efghij efghmj
13 bcd,adefgc,abghid,acijeb,bdjklf,belg,bflmhc,cgmi,chmkjd,dike,ejiml,ekmgf,glkih|10|7|bcimle bejimg
13 bcde,aefc,abfgd,acghe,adhifb,beijgc,cfjkhd,dgklie,ehlmjf,fimkg,gjmlh,hkmi,ilkj|6|6|cdef defg efgh
13 bcde,aefc,abfgd,acghie,adijfb,bejkgc,cfkhd,dgkli,dhlmje,eimkf,fjmlhg,hkmi,ilkj|8|6|cdef cdilkf cdimkf defg defkh dejkg dejkh dgfji dgkji efghi efkhi fghij hijk
13 bcde,aefc,abfgd,acghie,adijfb,bejkgc,cfklhd,dgli,dhlmje,eimkf,fjmlg,gkmih,ilkj|8|6|cdef cdilkf defg dejkg dejmlg dgfji dgkji efghi efgli efkli fglij ghijk
13 bcde,aefc,abfgd,acghie,adijfb,bejkgc,cfklhd,dgli,dhlmje,eimlkf,fjlg,gkjmih,ilj|9|7|cdef defg dejlg dgfji
13 bcde,aefc,abfgd,acghie,adijfb,bejkgc,cfklhd,dglkmi,dhmje,eimkf,fjmhlg,gkh,hkji|10|7|cdef cdhmjf defg defkh defkmh dejkg dejkh dgfji dgkji ghijk ghmk
13 bcde,aefc,abfgd,acghie,adijfb,bejkgc,cfklhd,dglmi,dhmje,eimkf,fjmlg,gkmh,hlkji|8|6|cdef defg defkmh dejmlg dgfji ghijk
13 bcde,aefc,abfgd,acghie,adijfb,bejkgc,cfklhd,dglmi,dhmkje,eikf,fjimlg,gkmh,hlki|7|5|cdef cdikf defg dejkg dgfji
13 bcde,aefc,abfghd,ache,adhifb,beijgc,cfjklh,cglied,ehlmjf,fimlkg,gjl,gkjmih,ilj|8|4|bche cfeh cfih fghi fgli gjil gjml
13 bcde,aefc,abfghd,achie,adijfb,bejgc,cfjklh,cglkid,dhkmje,eimkgf,gjmihl,gkh,ikj|12|8|acgkie cdef cdejg cdijf cdijg cdikjf ghij ghimk
13 bcde,aefc,abfghd,achie,adijfb,bejgc,cfjklh,cglmid,dhmlje,eilkgf,gjl,gkjimh,hli|12|8|acglie cdef cdejg cdejlg cdijf cdijg dhgfji dhgji dhli ghij ghilk
13 bcde,aefc,abfghd,achie,adijfb,bejkgc,cfklh,cglid,dhlmje,eimkf,fjmlg,gkmih,ilkj|8|7|cdef cdilkf
13 bcde,aefc,abfghd,achie,adijfb,bejkgc,cfklh,cglid,dhlmje,eimlkf,fjlg,gkjmih,ilj|10|7|cdef cdejlg cdiljf cdilkf cfeih defklh fghij hijl ijkl
13 bcde,aefc,abfghd,achie,adijfb,bejkgc,cfklh,cglmid,dhmje,eimlkf,fjlg,gkjmh,hlji|8|6|cdef cfeih fghij
13 bcde,aefc,abfghd,achie,adijfb,bejkgc,cfklh,cglmid,dhmlje,eilkf,fjlg,gkjimh,hli|10|6|cdef cdejlg cdilkf cfeih cfeilh dhgfji dhli fghij ghil
13 bcde,aefc,abfghd,achije,adjkfb,beklgc,cflh,cglid,dhlmj,dimke,ejmlf,fkmihg,ilkj|8|6|cdef cdjmlf deflh dekli
13 bcde,aefc,abfghd,achije,adjkfb,beklgc,cflh,cglmid,dhmj,dimke,ejmlf,fkmhg,hlkji|8|6|cdef cdjmlf cfejmh dhgfkj
13 bcde,aefc,abfghd,achije,adjkfb,beklgc,cflh,cglmid,dhmj,dimlke,ejlf,fkjmhg,hlji|7|5|cdef cdjlf
13 bcde,aefc,abfghd,achije,adjkfb,beklgc,cflh,cglmid,dhmkj,dike,ejimlf,fkmhg,hlki|8|5|cdef cdikf cfkih dhgfkj
13 bcde,aefc,abfghd,achije,adjkfb,beklgc,cflkmh,cgmid,dhmj,dimke,ejmglf,fkg,gkjih|10|6|cdef cdekg cdekmg cdimkf cfejmh dhgfkj dhgkj fgmk
13 bcde,aefc,abfghd,achije,adjkfb,beklgc,cflkmh,cgmjid,dhj,dihmke,ejmglf,fkg,gkjh|12|8|acgmje cdef cdekg cdekmg cdjkf cdjkg dhgfkj dhgkj dhmj
13 bcde,aefc,abfghd,achije,adjkfb,beklgc,cflmh,cgmid,dhmj,dimke,ejmlf,fkmg,glkjih|8|5|cdef cdekmg cdimkf dhgfkj
13 bcde,aefgc,abgd,acghe,adhifb,beijkg,bfkhdc,dgklie,ehlmjf,fimk,fjmlhg,hkmi,ilkj|6|3|bedg behg efgh efkh fihk filk
13 bcde,aefgc,abgfhd,achije,adjkfb,bekhcg,bfc,cfklid,dhlmj,dimlke,ejlhf,hkjmi,ilj|10|8|abfc acfe cdef defh dekh dhkj dhlj hijk ijkl
13 bcde,aefgc,abghd,achie,adijfb,bejklg,bflhc,cglmid,dhmkje,eikf,fjiml,fkmhg,hlki|9|7|achlfe bchie bchikf bedhg cdefg defgh efghi eflhi eflmi fghik fjihl
13 bcde,aefgc,abghd,achije,adjkfb,bekjlg,bflmhc,cgmlid,dhlj,dilfke,ejf,fjihmg,glh|12|8|abflhd abgljd bcdilf bchlje bedhlf bedhlg bedilg bejf cdefg cglh dhgfj ghil
13 bcde,aefgc,abghd,achije,adjkfb,beklg,bflhc,cglid,dhlmkj,dike,ejimlf,fkmihg,ilk|10|8|bedilg
13 bcde,aefgc,abghd,achije,adjkfb,beklg,bflhc,cglmid,dhmj,dimke,ejmlf,fkmhg,hlkji|9|8|bchlke bedhg cdefg cdeklg
13 bcde,aefgc,abghd,achije,adjkfb,beklg,bflhc,cglmid,dhmkj,dike,ejimlf,fkmhg,hlki|9|7|achlfe bchike bchikf bchlke bedhg bekihg cdefg cdeklg deklh dekmh dhgfkj dhlkj fghik
13 bcde,aefgc,abghd,achije,adjkfb,beklg,bflmhc,cgmid,dhmj,dimlke,ejlf,fkjmg,gljih|9|8|abgmjd bedhg
13 bcde,aefgc,abghd,achije,adjkfb,beklmg,bfmhc,cgmlid,dhlj,dilke,ejlf,fkjihm,flhg|9|7|abflhd abfmhd bcdjlf bchlf bedhg bejlhg defgh deflh defli dhgfkj
13 bcde,aefgc,abghd,achije,adjkfb,beklmg,bfmhc,cgmlid,dhlkj,dike,ejilf,fkihm,flhg|9|7|abflhd bcdikf bchikf bchlf bedhg
13 bcde,aefgc,abghid,acie,adijfb,bejkg,bfkhc,cgklmi,chmjed,eimlkf,fjlhg,hkjm,hlji|8|5|bchkje bcie cgfei
13 bcde,aefgc,abghid,acie,adijfb,bejklg,bflmhc,cgmi,chmjed,eimkf,fjml,fkmg,glkjih|8|5|acgmje bcie bcijf bcimlf beihg beimg cgfei
13 bcde,aefgc,abghid,acihje,adjkfb,beklmg,bfmjhc,cgjdi,chd,dhgmke,ejmlf,fkm,flkjg|11|8|abgjd acgje bchje bedhg bejg cdefg cdjg efgj efmj fgjk
13 bcde,aefgc,abghid,acihje,adjkfb,beklmg,bfmlhc,cgljdi,chd,dhlke,ejlf,fkjhgm,flg|12|9|acglje achd achlfe bcdjlf bedhg bflg cdeflg
13 bcde,aefgc,abghid,acije,adjkfb,beklg,bflhc,cglmi,chmjd,dimke,ejmlf,fkmhg,hlkji|10|8|acglke bcdjkf bchlke bchmje bchmke bchmkf bcimlf cgfeji cgfkji cgfkmi fghijk
13 bcde,aefgc,abghid,acijke,adklfb,belg,bflmhc,cgmji,chjd,dihmlk,djle,ekjmgf,gljh|8|6|bchjle cdelg
13 bcde,aefgc,abghid,acijke,adklfb,belhmg,bfmhc,cgmfli,chlkjd,dik,djile,ekihf,fhg|12|9|achfe acile bcdklf bchf bchle bchlf bcile bcilf bedihg bfhg cdefh cdelh cgfeki defhi deli dilk fghl
13 bcde,aefgc,abghid,acijke,adklfb,beljig,bfihc,cgi,chgfjd,diflmk,djmle,ekmjf,jlk|11|8|abfid acife bcdjf bcif bcig bedig cdefg defi defj delj efjk
13 bcde,aefgc,abghid,acijke,adklfb,beljmg,bfmihc,cgi,chgmjd,dimflk,djle,ekjf,fjig|10|6|abfmid acijfe bcdjf bcig bcijf bedig bedjmg cdefg cdjfg cgfji cgmi defgi defj
13 bcde,aefgc,abghid,acijke,adklfb,belkmg,bfmihc,cgi,chgmjd,dimk,djmfle,ekf,fkjig|12|8|abfmid bcdkmf bcig bcimke cdefg
13 bcde,aefgc,abghid,acijke,adklfb,belmg,bfmhc,cgmji,chjd,dihmlk,djle,ekjmf,fljhg|9|7|bcdjlf bcdjmf bchjle bchjlf cdefg
13 bcde,aefghc,abhid,acije,adjfb,bejkg,bfklh,bglmic,chmjd,dimkfe,fjmlg,gkmh,hlkji|9|8|bcdjf bcije bedih bfjih
13 bcde,aefghc,abhid,acije,adjkfb,beklg,bflmh,bgmjic,chjd,dihmke,ejmlf,fkmg,glkjh|9|7|abhjd bejh bejmg bekmg bfkmh
13 bcdef,afghc,abhd,achije,adjf,aejkgb,bfklmh,bgmidc,dhmlj,dilkfe,fjlg,gkjim,glih|8|7|bfjdh
13 bcdef,afghc,abhijd,acje,adjklf,aelkgb,bfkmih,bgic,chgmj,cimked,ejmgfl,ekf,gkji|10|7|abgije acigke acjmgf aekf chgfej
13 bcdef,afghc,abhijd,acje,adjklf,aelmgb,bfmh,bgmkic,chkj,ciked,ejihml,ekmf,flkhg|8|6|chmfej
13 bcdefg,aghijc,abjd,acjke,adklf,aelg,aflhb,bglmi,bhmj,bimkdc,djmle,ekmhgf,hlkji|8|7|abjmle
13 bcdefg,aghijc,abjd,acjke,adklf,aelg,aflhb,bglmi,bhmkj,bikdc,djimle,ekmhgf,hlki|8|7|abhlkd
13 bcdefg,aghijc,abjd,acjke,adklf,aelmg,afmhb,bgmli,bhlkj,bikdc,djile,ekihmf,flhg|9|8|abhlf abhlkd abikd aelhg
13 bcdefg,aghijc,abjkd,acke,adklf,aelg,aflhb,bglmi,bhmj,bimkc,cjmled,ekmhgf,hlkji|9|7|abhle abhlkd abhmkd abhmke acklf acklg bcklg bckmh bhlkj
4 bcd,adc,abd,acb|1|1|abcd
5 bcd,adec,abed,aceb,bdc|0|0|
6 bcd,adec,abefd,acfeb,bdfc,ced|1|1|acfd
6 bcde,aefc,abfd,acfe,adfb,bedc|0|0|
7 bcd,adec,abefd,acfgeb,bdgfc,cegd,dfe|3|3|abegd cde
7 bcd,adec,abefgd,acgfeb,bdfc,cedg,cfd|2|1|acfd acgd
7 bcd,adefc,abfgd,acgeb,bdgf,begc,cfed|2|2|abed bcde
7 bcd,adefgc,abgfd,acfeb,bdf,bedcg,bfc|4|3|abed abfc acfd bcdf
7 bcde,aefc,abfgd,acge,adgfb,begc,cfed|0|0|
8 bcd,adec,abefd,acfgeb,bdghfc,cehgd,dfhe,egf|5|3|acfd bcfd cde cedf
8 bcd,adec,abefgd,acgheb,bdhfc,cehg,cfhd,dgfe|3|2|acgd bcgd cedg
8 bcd,adec,abefgd,acgheb,bdhgfc,ceg,cfehd,dge|5|3|acgd bcgd cedg cehg efgh
8 bcd,adefc,abfgd,acgeb,bdghf,behgc,cfhed,egf|5|4|abed bcde bcge
8 bcd,adefc,abfghd,achgeb,bdgf,begc,cfedh,cgd|3|2|acgd achd bcgd
8 bcd,adefgc,abgfhd,achfeb,bdf,bedhcg,bfc,cfd|5|3|abed abfc bcdf
8 bcd,adefgc,abghd,acheb,bdhf,behg,bfhc,cgfed|3|2|abed achd bcde bchd bche
8 bcd,adefgc,abghd,acheb,bdhgf,beg,bfehc,cged|5|4|abed abegc abfed achd bcde bchd bche
8 bcde,aefc,abfgd,acghe,adhfb,behgc,cfhd,dgfe|1|1|cdef
8 bcde,aefc,abfghd,ache,adhgfb,begc,cfeh,cged|1|0|acge
9 bcd,adec,abefd,acfgeb,bdghfc,cehigd,dfihe,egif,fhg|7|5|abegd acfgd acfigd cde cdge def
9 bcd,adec,abefgd,acgheb,bdhfc,cehig,cfihd,dgife,fhg|6|4|acgd bcgd cdhf cedg cehg efgh efih
9 bcd,adec,abefgd,acgheb,bdhifc,ceig,cfihd,dgie,ehgf|4|2|acgd bcgd cedg cehg
9 bcd,adec,abefgd,acgheb,bdhifc,ceihg,cfhd,dgfie,ehf|6|4|acgd bcgd cedg cehg efgh fghi
9 bcd,adefc,abfgd,acgheb,bdhgif,beigc,cfiehd,dge,egf|6|4|abfc bdcf bdgf defg deig efgh ehgi
9 bcd,adefc,abfghd,achieb,bdif,beigc,cfih,cgid,dhgfe|4|3|abed abfc bcde bdcf cdef cdif
9 bcd,adefc,abfghd,achieb,bdif,beihgc,cfh,cgfid,dhfe|6|5|abed abfgc abfhc acfhd achd bcde bchd bdhf cdef
9 bcd,adefc,abfghd,achieb,bdihf,behgc,cfh,cgfeid,dhe|8|6|abed abehd abeid acfhd acfhid acghd bcde bche
9 bcd,adefgc,abghd,acheb,bdhf,behig,bfihc,cgifed,fhg|6|5|abed abgc bcde bche bchf bdcg
9 bcd,adefgc,abghd,acheb,bdhif,beig,bfihc,cgied,ehgf|4|3|abed achd bcde bchd bche behg
9 bcde,aefc,abfghd,ache,adhifb,beihgc,cfh,cgfied,ehf|4|2|bche cfeh cfih fghi
9 bcde,aefgc,abghd,achie,adifb,beig,bfihc,cgid,dhgfe|3|3|abgid
9 bcdef,afghic,abid,acie,adihgf,aegb,bfeh,bgei,bhedc|2|1|abhe abie
9 bcdef,afghic,abid,acihe,adhgf,aegb,bfeh,bgedi,bhdc|2|2|abhd
9 bcdefg,agheic,abid,acie,adibhf,aehg,afhb,bgfe,bedc|4|3|abed acbg
)";

}  // namespace hexfield::hex
